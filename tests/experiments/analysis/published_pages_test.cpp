// The tables that are committed beside the pages hold what is expected of their experiments.
#include <gtest/gtest.h>

#include <espalier/experiments/analysis/check.h>

namespace espalier {
namespace {

namespace fs = std::filesystem;

TEST(PublishedPages, HoldWhatTheirExperimentsAreExpectedToShow) {
  const fs::path experiments = fs::path(ESPALIER_SOURCE_DIR) / "experiments";
  int checked_pages = 0;
  for (const fs::directory_entry& page : fs::directory_iterator(experiments / "results")) {
    const fs::path expected = experiments / (page.path().filename().string() + ".expected.toml");
    if (!fs::exists(expected)) continue;
    ++checked_pages;
    for (const CheckedExpectation& checked : check_expectations(read_expectations(expected), page.path()))
      EXPECT_TRUE(checked.holds) << page.path().filename() << ": " << checked.expectation.text() << ", got "
                                 << checked.got;
  }
  EXPECT_GE(checked_pages, 6)
      << "closeness, unseen_side, posterior_calibration, optimizers, ga_progress, growth";
}

}  // namespace
}  // namespace espalier
