// From a picture to its directory: what is left there, stopped and gone on with, and pictures of no tree.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include <espalier/core/field_error.h>
#include <espalier/core/files.h>
#include <espalier/fitting/posterior/posterior_run.h>
#include <espalier/fitting/posterior/simulations/plant_simulator.h>
#include <espalier/fitting/posterior/simulations/reference_table.h>
#include <espalier/models/models.h>

#include "support/prior_silhouettes.h"
#include "support/small_training.h"
#include "support/temporary_folders.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A table that all tests share.
fs::path shared_table() {
  static const fs::path path = fresh_folder("posterior_table") / "table.bin";
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

TEST(PosteriorRun, LeavesSamplesIntervalsAndPictures) {
  const fs::path folder = fresh_folder("posterior_run");
  const PosteriorResult result = compute_posterior(small_request(), tree_of(1), folder, 0, always);
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

TEST(PosteriorRun, StoppedAndGoneOnWithIsTheSame) {
  const fs::path whole = fresh_folder("posterior_whole"), parts = fresh_folder("posterior_parts");
  PosteriorRequest request = small_request();
  compute_posterior(request, tree_of(2), whole, 1, always);
  request.table.clear();
  const PosteriorResult stopped = compute_posterior(
      request, tree_of(2), parts, 2, [](std::size_t done, std::size_t) { return done < 1000; });
  EXPECT_FALSE(stopped.is_complete());
  EXPECT_GE(stopped.simulations, 1000u);
  EXPECT_FALSE(fs::exists(parts / "samples.csv"));
  EXPECT_TRUE(compute_posterior(request, tree_of(2), parts, 2, always).is_complete());
  for (const std::string& name : result_files())
    EXPECT_EQ(read_file(whole / name), read_file(parts / name)) << name;
}

TEST(PosteriorRun, OfASquareSaysThatNoPlantMakesItAndGivesThePrior) {
  const PosteriorResult result =
      compute_posterior(small_request(), square(), fresh_folder("posterior_square"), 0, always);
  EXPECT_FALSE(result.check.is_likely());
  EXPECT_THAT(posterior_in_words(result), testing::StartsWith("no plant of the prior makes such a picture"));
  for (const UnknownSummary& row : result.unknowns) EXPECT_GT(row.width_share, 0.95) << row.unknown.name;
}

TEST(PosteriorRun, OfTreesOfThePriorIsSeldomUnlikely) {
  int unlikely = 0;
  for (std::uint64_t i = 10; i < 16; ++i)
    unlikely += !compute_posterior(small_request(), tree_of(i), fresh_folder("posterior_trees"), 0, always)
                     .check.is_likely();
  EXPECT_LE(unlikely, 1);
}

/// Mean share of the unknowns of trees outside of the table that lie in their 90 % intervals, these narrowed.
double coverage_90(double narrowed) {
  constexpr std::uint64_t kTrees = 100;
  static const PlantPrior prior(model_by_name("weber_penn"));
  const ReferenceTable table = read_table(shared_table(), prior, 1, 10);
  const auto rows = static_cast<Eigen::Index>(kLeastTableSize);
  const PosteriorEstimator estimator(table.unknowns.topRows(rows), table.summaries.topRows(rows),
                                     small_training());
  PlantSimulator simulator(prior, 10);
  double held = 0, counted = 0;
  for (std::uint64_t i = 0; i < kTrees; ++i) {
    Simulation tree;
    if (!simulator.simulate(prior.draw(child_key(root_key(99), i)), tree)) continue;
    const Posterior posterior = estimator.estimate(tree.summaries);
    for (std::size_t k = 0; k < tree.unknowns.size(); ++k) {
      const double middle = posterior_quantile(posterior, k, 0.5);
      const double lower = middle + narrowed * (posterior_quantile(posterior, k, 0.05) - middle);
      const double upper = middle + narrowed * (posterior_quantile(posterior, k, 0.95) - middle);
      held += lower <= tree.unknowns[k] && tree.unknowns[k] <= upper ? 1 : 0;
      counted += 1;
    }
  }
  return held / counted;
}

/// The large version is experiments/posterior_calibration.cpp.
TEST(PosteriorRun, IntervalsHoldTheTreesOfThePriorAndNarrowerOnesDoNot) {
  compute_posterior(small_request(), tree_of(1), fresh_folder("posterior_coverage"), 0,
                    always);  // makes the table
  EXPECT_NEAR(coverage_90(1), 0.9, 0.025);
  EXPECT_LT(coverage_90(2.0 / 3), 0.82);
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

}  // namespace
}  // namespace espalier
