#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>

#include <espalier/core/error.h>
#include <espalier/experiments/statistics/data_profile.h>

namespace espalier {
namespace {

using testing::ElementsAre;

/// Three levels, with gaps of 1, 1/10 and 1/100 of that between base and best.
const LevelSettings kThreeLevels = {.first_evaluations = 100, .levels = 3, .smallest_gap = 0.01};

std::vector<double> shares(const std::vector<ProfileRow>& rows, const std::string& optimizer) {
  std::vector<double> shares;
  for (const ProfileRow& row : rows)
    if (row.optimizer == optimizer) shares.push_back(row.share);
  return shares;
}

TEST(FitnessLevels, AreEvenlySpacedInTheLogarithmOfTheGapToTheBest) {
  const std::vector<StepCurve> curves = {{{50, 900}, {0.0, 1.0}}, {{100}, {0.2}}, {{10, 80}, {0.0, 0.4}}};
  const auto levels = fitness_levels(curves, kThreeLevels);  // after 100: 0, 0.2, 0.4; the best is 1
  ASSERT_EQ(levels.size(), 3u);
  EXPECT_DOUBLE_EQ(levels[0], 0.2);
  EXPECT_DOUBLE_EQ(levels[1], 0.92);
  EXPECT_DOUBLE_EQ(levels[2], 0.992);
}

TEST(FitnessLevels, TakeTheFirstRowOfACurveThatBeginsLate) {
  const std::vector<StepCurve> curves = {{{500, 600}, {0.5, 1.0}}};
  EXPECT_DOUBLE_EQ(fitness_levels(curves, kThreeLevels)[0], 0.5);
}

TEST(FitnessLevels, AreNoneWhereEveryRunFailed) {
  EXPECT_TRUE(fitness_levels(std::vector<StepCurve>(2), kThreeLevels).empty());
}

TEST(FitnessLevels, RefusesAGapOfNothing) {
  EXPECT_THROW(fitness_levels({}, {.smallest_gap = 0}), InternalError);
}

// By hand. Target t: after 100 evaluations 0 and 0, the best 1, so levels 0, 0.9, 0.99. "fast" reaches them
// after 10, 200, 200 evaluations, "slow" after 20, 400 and never. Target u: one run a method, both 0.5 at
// once: base and best are 0.5, so that all its levels are 0.5, reached after 10 and 20; a second run of slow
// failed.
const std::vector<ProfileRun> kRuns = {{"fast", "t", {{10, 200}, {0.0, 1.0}}},
                                       {"slow", "t", {{20, 400}, {0.0, 0.95}}},
                                       {"fast", "u", {{10}, {0.5}}},
                                       {"slow", "u", {{20}, {0.5}}},
                                       {"slow", "u", {}}};

TEST(DataProfiles, AreTheSharesCountedByHand) {
  const std::vector<long> grid = {9, 10, 20, 200, 400, 5000};
  const auto rows = data_profiles(kRuns, grid, kThreeLevels);
  EXPECT_THAT(shares(rows, "fast"), ElementsAre(0, 4 / 6.0, 4 / 6.0, 1, 1, 1));
  EXPECT_THAT(shares(rows, "slow"), ElementsAre(0, 0, 4 / 9.0, 4 / 9.0, 5 / 9.0, 5 / 9.0));
}

TEST(DataProfiles, KeepTheOrderOfTheRuns) {
  const std::vector<long> grid = {10};
  const auto rows = data_profiles(kRuns, grid, kThreeLevels);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].optimizer, "fast");
  EXPECT_EQ(rows[1].optimizer, "slow");
}

TEST(DataProfiles, OfAMethodThatAlwaysFailedAreZero) {
  const std::vector<ProfileRun> runs = {{"good", "t", {{10, 20}, {0.1, 0.2}}}, {"bad", "t", {}}};
  const std::vector<long> grid = {1000};
  EXPECT_THAT(shares(data_profiles(runs, grid), "bad"), ElementsAre(0));
}

std::vector<ProfileRun> random_runs() {
  std::vector<ProfileRun> runs;
  for (int run = 0, count = *rc::gen::inRange(1, 12); run < count; ++run) {
    ProfileRun next{std::to_string(*rc::gen::inRange(0, 3)), std::to_string(*rc::gen::inRange(0, 3)), {}};
    for (int row = 0, rows = *rc::gen::inRange(0, 5); row < rows; ++row) {
      const bool first = next.curve.best.empty();
      next.curve.evaluations.push_back((first ? 0 : next.curve.evaluations.back()) +
                                       *rc::gen::inRange(1, 99));
      next.curve.best.push_back((first ? 0 : next.curve.best.back()) + *rc::gen::inRange(0, 9) / 10.0);
    }
    runs.push_back(next);
  }
  return runs;
}

RC_GTEST_PROP(DataProfiles, RiseFromZeroToAtMostOne, ()) {
  const auto runs = random_runs();
  const std::vector<long> grid = {0, 1, 10, 50, 100, 200, 500};
  std::map<std::string, double> before;
  for (const ProfileRow& row : data_profiles(runs, grid)) {
    RC_ASSERT(row.evaluations > 0 || row.share == 0);
    RC_ASSERT(row.share >= before[row.optimizer]);
    RC_ASSERT(row.share <= 1);
    before[row.optimizer] = row.share;
  }
}

}  // namespace
}  // namespace espalier
