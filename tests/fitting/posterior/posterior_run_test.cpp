// From a picture to its directory: what is left there, stopped and gone on with, and pictures of no tree.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <espalier/core/field_error.h>
#include <espalier/core/files.h>
#include <espalier/fitting/posterior/posterior_run.h>
#include <espalier/fitting/posterior/simulations/plant_simulator.h>
#include <espalier/fitting/posterior/simulations/reference_table.h>
#include <espalier/machine/directory_lock.h>
#include <espalier/models/models.h>

#include "support/posterior_table.h"
#include "support/prior_silhouettes.h"
#include "support/small_training.h"
#include "support/temporary_folders.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const PlantPrior& prior() {
  static const PlantPrior made(model_by_name("weber_penn"));
  return made;
}

/// A table that all tests share.
fs::path shared_table() {
  static const fs::path path = [] {
    const fs::path file = fresh_folder("posterior_table") / "table.bin";
    take_kept_table(prior(), kLeastTableSize, file);
    return file;
  }();
  return path;
}

PosteriorRequest small_request() {
  return {.picture = "tree.png",
          .simulations = kLeastTableSize,
          .samples = 50,
          .table = shared_table(),
          .version = "test",
          .training = small_training()};
}

bool always(std::size_t, std::size_t) { return true; }

Mask tree_of(std::uint64_t i) { return silhouette_of_prior(77, i); }

Mask square() {
  Mask mask(200, 200);
  for (int y = 40; y < 160; ++y)
    for (int x = 40; x < 160; ++x) mask.set(x, y);
  return mask;
}

const std::vector<std::string>& result_files() {
  static const std::vector<std::string> names = {"samples.csv",    "intervals.csv",  "summaries.csv",
                                                 "parameters.svg", "parameters.png", "pairs.svg",
                                                 "pairs.png",      "silhouette.png", "posterior.json"};
  return names;
}

struct WholeRun {
  fs::path folder = fresh_folder("posterior_whole");
  PosteriorResult result = compute_posterior(small_request(), tree_of(1), folder, 1, always);
};

/// The run that makes the table where there is none.
const WholeRun& whole_run() {
  static const WholeRun run;
  return run;
}

/// The table of the whole run, or of others of its seed and height.
ReferenceTable table_at(const fs::path& path) { return read_table(path, prior(), 1, 10); }

ReferenceTable whole_table() {
  whole_run();
  return table_at(shared_table());
}

TEST(PosteriorRun, LeavesSamplesIntervalsAndPictures) {
  const auto& [folder, result] = whole_run();
  ASSERT_TRUE(result.is_complete());
  for (const std::string& name : result_files()) EXPECT_TRUE(fs::exists(folder / name)) << name;
  const std::string samples = read_file(folder / "samples.csv"),
                    intervals = read_file(folder / "intervals.csv");
  EXPECT_EQ(std::count(samples.begin(), samples.end(), '\n'), 51);
  EXPECT_EQ(std::count(intervals.begin(), intervals.end(), '\n'),
            static_cast<long>(result.unknowns.size()) + 1);
  for (const UnknownSummary& row : result.unknowns) {
    EXPECT_LE(row.intervals[2].first, row.intervals[1].first) << row.unknown.name;
    EXPECT_LE(row.intervals[1].first, row.intervals[0].first);
    EXPECT_LE(row.intervals[0].first, row.median);
    EXPECT_LE(row.median, row.intervals[0].second);
    EXPECT_LE(row.intervals[1].second, row.intervals[2].second);
  }
  double all = 0;
  for (const SpeciesShare& species : result.species) all += species.share;
  EXPECT_NEAR(all, 1, 1e-9);
  EXPECT_THAT(posterior_in_words(result), HasSubstr("crown_volume"));
}

bool are_equal(const ReferenceTable& a, const ReferenceTable& b) {
  return a.unknowns == b.unknowns && a.summaries == b.summaries && a.species == b.species &&
         a.attempt == b.attempt;
}

/// Stopped, it leaves the first rows of the unbroken table; with such rows it ends as the unbroken run.
/// Between the two steps are simulations that are the same rows again: they are taken from that table.
TEST(PosteriorRun, StoppedAndGoneOnWithIsTheSame) {
  const ReferenceTable table = whole_table();
  const fs::path parts = fresh_folder("posterior_parts");
  PosteriorRequest request = small_request();
  request.table.clear();
  const PosteriorResult stopped = compute_posterior(request, tree_of(1), parts, 2,
                                                    [](std::size_t done, std::size_t) { return done < 100; });
  EXPECT_FALSE(stopped.is_complete());
  EXPECT_GE(stopped.simulations, 100u);
  EXPECT_FALSE(fs::exists(parts / "samples.csv"));
  const ReferenceTable left = table_at(parts / "table.bin");
  ASSERT_EQ(left.size(), stopped.simulations);
  ASSERT_LT(left.size(), table.size());
  EXPECT_TRUE(are_equal(left, first_rows(table, left.size())));
  write_table(parts / "table.bin", prior(), first_rows(table, table.size() - 100));
  EXPECT_TRUE(compute_posterior(request, tree_of(1), parts, 2, always).is_complete());
  EXPECT_TRUE(are_equal(table_at(parts / "table.bin"), table));
  for (const std::string& name : result_files())
    EXPECT_EQ(read_file(whole_run().folder / name), read_file(parts / name)) << name;
}

TEST(PosteriorRun, OfASquareSaysThatNoPlantMakesItAndGivesThePrior) {
  whole_run();
  const PosteriorResult result =
      compute_posterior(small_request(), square(), fresh_folder("posterior_square"), 0, always);
  EXPECT_FALSE(result.check.is_likely());
  EXPECT_THAT(posterior_in_words(result), testing::StartsWith("no plant of the prior makes such a picture"));
  for (const UnknownSummary& row : result.unknowns) EXPECT_GT(row.width_share, 0.95) << row.unknown.name;
}

TEST(PosteriorRun, OfTreesOfThePriorIsSeldomUnlikely) {
  int unlikely = !whole_run().result.check.is_likely();
  for (std::uint64_t i = 10; i < 13; ++i)
    unlikely += !compute_posterior(small_request(), tree_of(i), fresh_folder("posterior_trees"), 0, always)
                     .check.is_likely();
  EXPECT_LE(unlikely, 1);
}

struct JudgedTree {
  std::vector<double> unknowns;
  Posterior posterior;
};

/// Trees outside of the table, and what it makes of their pictures.
std::vector<JudgedTree> judged_trees() {
  constexpr std::uint64_t kTrees = 100;
  const ReferenceTable table = whole_table();
  const PosteriorEstimator estimator(table.unknowns, table.summaries, small_training());
  PlantSimulator simulator(prior(), 10);
  std::vector<JudgedTree> trees;
  for (std::uint64_t i = 0; i < kTrees; ++i)
    if (Simulation tree; simulator.simulate(prior().draw(child_key(root_key(99), i)), tree))
      trees.push_back({tree.unknowns, estimator.estimate(tree.summaries)});
  return trees;
}

/// Mean share of the trees' unknowns that lie in their 90 % intervals, these narrowed.
double coverage_90(const std::vector<JudgedTree>& trees, double narrowed) {
  double held = 0, counted = 0;
  for (const auto& [unknowns, posterior] : trees)
    for (std::size_t k = 0; k < unknowns.size(); ++k) {
      const double middle = posterior_quantile(posterior, k, 0.5);
      const double lower = middle + narrowed * (posterior_quantile(posterior, k, 0.05) - middle);
      const double upper = middle + narrowed * (posterior_quantile(posterior, k, 0.95) - middle);
      held += lower <= unknowns[k] && unknowns[k] <= upper ? 1 : 0;
      counted += 1;
    }
  return held / counted;
}

/// The large version is experiments/posterior_calibration.cpp.
TEST(PosteriorRun, IntervalsHoldTheTreesOfThePriorAndNarrowerOnesDoNot) {
  const std::vector<JudgedTree> trees = judged_trees();
  EXPECT_NEAR(coverage_90(trees, 1), 0.9, 0.025);
  EXPECT_LT(coverage_90(trees, 2.0 / 3), 0.82);
}

TEST(PosteriorRun, RefusesTooFewSimulationsAndHeightsThatAreNone) {
  const auto field = [](const PosteriorRequest& request) -> std::string {
    try {
      check_request(request);
    } catch (const FieldError& error) {
      return error.field;
    }
    return "";
  };
  PosteriorRequest request;
  EXPECT_EQ(field(request), "");
  request.simulations = 100;
  EXPECT_EQ(field(request), "simulations");
  request = {};
  for (const double height : {0.0, -1.0, 1e9}) {
    request.height_m = height;
    EXPECT_EQ(field(request), "height");
  }
  request = {};
  request.samples = 0;
  EXPECT_EQ(field(request), "samples");
}

TEST(PosteriorRun, OtherThingsAreThoseThatNoPosteriorLeavesWhereverItIsKilled) {
  const fs::path folder = fresh_folder("posterior_places");
  EXPECT_FALSE(holds_other_things(folder / "none"));
  EXPECT_FALSE(holds_other_things(folder));
  std::ofstream(folder / "samples.csv") << "mine";
  EXPECT_TRUE(holds_other_things(folder)) << "without a lock nobody began here";
  std::ofstream(folder / "lock") << "";
  std::ofstream(folder / "table.bin") << "half";
  std::ofstream(folder / ".espalier-0011223344556677.tmp") << "half";
  for (const std::string& name : result_files()) std::ofstream(folder / name) << "half";
  EXPECT_FALSE(holds_other_things(folder));
  std::ofstream(folder / "notes.txt") << "mine";
  EXPECT_TRUE(holds_other_things(folder));
}

TEST(PosteriorRun, IsOneProcesssAtATime) {
  const fs::path directory = fresh_folder("locked_posterior");
  const DirectoryLock lock(directory);
  EXPECT_THAT([&] { compute_posterior(small_request(), tree_of(1), directory, 1, always); },
              testing::ThrowsMessage<InputError>(HasSubstr("another process works in")));
}

}  // namespace
}  // namespace espalier
