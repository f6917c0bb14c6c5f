// Which methods are compared, by what, and what counts as a data set of its own.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <espalier/experiments/analysis/rank_tables.h>

namespace espalier {
namespace {

using testing::ElementsAre;

/// Method "a" is best on every target, whatever the seed; "b" and "c" change places from seed to seed.
std::vector<FinishedFit> fits_of(int targets, int seeds) {
  std::vector<FinishedFit> fits;
  for (int target = 0; target < targets; ++target)
    for (int seed = 0; seed < seeds; ++seed)
      for (const std::string method : {"a", "b", "c"}) {
        FinishedFit fit;
        fit.target = fmt::format("t{}", target), fit.method = method, fit.seed = fmt::format("{}", seed);
        fit.objective = "iou";
        const double value = method == "a" ? 0.9 : (method == "b") == (seed % 2 == 0) ? 0.6 : 0.4;
        fit.measures["fitness"] = value + 0.01 * target;
        fits.push_back(fit);
      }
  return fits;
}

std::string value(const CsvTable& friedman, const std::string& statistic) {
  for (std::size_t row = 0; row < friedman.rows.size(); ++row)
    if (friedman.text(row, "statistic") == statistic) return friedman.text(row, "value");
  return "none";
}

TEST(RankTables, SeedsAreNoDataSets) {
  for (const int seeds : {1, 2, 8}) {
    const auto tables = rank_tables(fits_of(5, seeds));
    EXPECT_EQ(value(tables.at("friedman_fitness.csv"), "blocks"), "5") << seeds;
    EXPECT_EQ(tables.at("ranks_fitness.csv").text(0, "optimizer"), "a");
    EXPECT_EQ(tables.at("ranks_fitness.csv").text(0, "mean_rank"), "1");
  }
}

TEST(RankTables, UnseenSeedsComeFirst) {
  std::vector<FinishedFit> fits = fits_of(3, 2);
  EXPECT_THAT(ranked_measures(fits), ElementsAre("fitness"));
  for (FinishedFit& fit : fits) fit.measures["unseen_fitness"] = fit.method == "c" ? 0.8 : 0.3;
  EXPECT_THAT(ranked_measures(fits), ElementsAre("unseen_fitness", "fitness"));
  EXPECT_EQ(rank_tables(fits).at("ranks_unseen_fitness.csv").text(0, "optimizer"), "c");
}

TEST(RankTables, ObjectivesAreNotTheirOwnJudges) {
  std::vector<FinishedFit> fits = fits_of(3, 2);
  for (FinishedFit& fit : fits) {
    fit.measures["iou"] = 1 - fit.measures["fitness"];
    if (fit.method == "a") fit.objective = "truncated_distance";
  }
  EXPECT_THAT(ranked_measures(fits), ElementsAre("iou"));
  EXPECT_EQ(rank_tables(fits).count("ranks_fitness.csv"), 0u);
  EXPECT_NE(rank_tables(fits).at("ranks_iou.csv").text(0, "optimizer"), "a");
}

TEST(RankTables, AFailedRunCountsAsNothingReached) {
  std::vector<FinishedFit> fits = fits_of(4, 2);
  for (FinishedFit& fit : fits)
    if (fit.method == "a") fit.failed = true;
  EXPECT_EQ(rank_tables(fits).at("ranks_fitness.csv").text(2, "optimizer"), "a");
}

TEST(RankTables, TargetsWithoutAllRunsAreLeftOut) {
  std::vector<FinishedFit> fits = fits_of(4, 2);
  fits.pop_back();
  EXPECT_EQ(value(rank_tables(fits).at("friedman_fitness.csv"), "blocks"), "3");
}

TEST(RankTables, OfFewMethodsEachPairIsCompared) {
  const auto tables = rank_tables(fits_of(8, 2));
  const CsvTable& pairs = tables.at("pairs_fitness.csv");
  ASSERT_EQ(pairs.rows.size(), 3u);
  EXPECT_EQ(pairs.text(0, "better"), "a");
  EXPECT_EQ(pairs.text(0, "worse"), "b");
  EXPECT_NEAR(pairs.number(0, "median_difference"), 0.4, 1e-9);
  EXPECT_NEAR(pairs.number(0, "p_value"), 2.0 / 256, 1e-9);
  EXPECT_NEAR(pairs.number(0, "p_holm"), 3 * 2.0 / 256, 1e-9);
  EXPECT_EQ(pairs.number(2, "p_value"), 1);  // b and c: equal on each target
}

}  // namespace
}  // namespace espalier
