// The tables that are committed beside the pages hold what is expected of their experiments.
#include <gtest/gtest.h>

#include <espalier/core/files.h>
#include <espalier/experiments/analysis/check.h>
#include <espalier/experiments/declaration/experiment.h>
#include <espalier/experiments/runner/csv.h>
#include <espalier/experiments/runner/run_experiment.h>

#include "support/temporary_folders.h"

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
  EXPECT_GE(checked_pages, 7)
      << "closeness, unseen_side, posterior_calibration, curve_recovery, optimizers, ga_progress, growth";
}

/// A result repeats itself: its declaration is there, is that of the experiment that comes with Espalier, and
/// can be run from where it lies.
TEST(PublishedPages, HoldTheDeclarationsThatTheyCameFrom) {
  const fs::path experiments = fs::path(ESPALIER_SOURCE_DIR) / "experiments";
  int sheets_and_growth = 0;
  for (const fs::directory_entry& page : fs::directory_iterator(experiments / "results")) {
    const fs::path declaration = page.path() / "experiment.toml";
    const fs::path bundled = experiments / (page.path().filename().string() + ".toml");
    if (!fs::exists(bundled)) continue;
    const Experiment experiment = read_experiment(bundled);
    if (experiment.fits && !fs::exists(declaration)) continue;
    ASSERT_TRUE(fs::exists(declaration)) << page.path();
    EXPECT_TRUE(same_runs(read_file(declaration), read_file(bundled))) << declaration;
    if (experiment.fits) continue;
    ++sheets_and_growth;
    const Plan plan = plan_of(read_experiment(declaration), fresh_folder("plan"));
    const CsvTable results = read_csv(page.path() / "results.csv");
    ASSERT_EQ(results.rows.size(), plan.runs.size()) << page.path();
    for (std::size_t run = 0; run < plan.runs.size(); ++run) {
      EXPECT_EQ(results.text(run, "run"), plan.runs[run].name) << page.path();
      for (const auto& [column, label] : plan.runs[run].labels) EXPECT_EQ(results.text(run, column), label);
      EXPECT_EQ(results.text(run, "status"), "done") << page.path();
    }
    EXPECT_EQ(fs::exists(page.path() / "sheet.png"), experiment.pictures.has_value()) << page.path();
  }
  EXPECT_GE(sheets_and_growth, 16);
}

}  // namespace
}  // namespace espalier
