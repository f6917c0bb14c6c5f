// Scores: bounded for trees, worse and finite beyond the budget, the same for any number of threads.
#include <gtest/gtest.h>

#include <cmath>

#include <espalier/fitting/task/plant_scorer.h>

#include "support/fakes.h"

namespace espalier {
namespace {

std::vector<double> scores_of(const FitTask& task, const std::vector<ParameterValues>& candidates,
                              int threads) {
  std::vector<double> scores(candidates.size());
  PlantScorer(task, threads).score(candidates, scores);
  return scores;
}

std::vector<ParameterValues> some_poles() {
  std::vector<ParameterValues> poles;
  for (int i = 0; i < 40; ++i) poles.push_back({2 + 0.3 * i, 0.02 + 0.01 * (i % 7), 1});
  return poles;
}

TEST(PlantScorer, ScoresTheTargetItselfAsPerfect) {
  const PoleModel model;
  EXPECT_LT(scores_of(pole_task(model), {{10, 0.1, 1}}, 1)[0], 0.05);
}

TEST(PlantScorer, PrefersTheTallerOfTwoPolesThatAreTooShort) {
  const PoleModel model;
  const auto scores = scores_of(pole_task(model), {{5, 0.2, 1}, {8, 0.125, 1}}, 1);
  EXPECT_GT(scores[0], scores[1]);
}

TEST(PlantScorer, GivesTheSameBitsForAnyNumberOfThreads) {
  const PoleModel model;
  const FitTask task = pole_task(model, {0, 1, 2});
  const auto one = scores_of(task, some_poles(), 1);
  for (const int threads : {2, 3, 8}) EXPECT_EQ(one, scores_of(task, some_poles(), threads)) << threads;
}

TEST(PlantScorer, AveragesOverSeeds) {
  const PoleModel model;
  const ParameterValues pole = {9, 0.1, 1};
  double sum = 0;
  for (const Seed seed : {1, 2, 3}) sum += scores_of(pole_task(model, {seed}), {pole}, 1)[0];
  EXPECT_DOUBLE_EQ(scores_of(pole_task(model, {1, 2, 3}), {pole}, 2)[0], sum / 3);
}

TEST(PlantScorer, AveragesOverViews) {
  const PoleModel model;
  FitTask both = pole_task(model);
  Mask short_pole(64, 64);
  for (int y = 40; y < 62; ++y) short_pole.set(32, y);
  both.views.push_back(make_target_view(short_pole, 22, {.azimuth_deg = 90}, 10));
  FitTask second = both;
  second.views.erase(second.views.begin());
  const ParameterValues pole = {9, 0.1, 1};
  EXPECT_DOUBLE_EQ(scores_of(both, {pole}, 1)[0],
                   (scores_of(pole_task(model), {pole}, 1)[0] + scores_of(second, {pole}, 1)[0]) / 2);
}

TEST(PlantScorer, PenalisesWhatExceedsTheBudgetByHowMuch) {
  const PoleModel model;
  const auto scores = scores_of(pole_task(model), {{10, 0.1, 100}, {10, 0.1, 1000}, {10, 0.1, 1e9}}, 1);
  EXPECT_LE(scores[0], 1);
  EXPECT_DOUBLE_EQ(scores[1], 2);
  EXPECT_DOUBLE_EQ(scores[2], 8);
}

TEST(PlantScorer, PenaltiesAreFinite) {
  EXPECT_TRUE(std::isfinite(over_budget_penalty(INFINITY)));
  EXPECT_GE(over_budget_penalty(0.5), 1);
}

TEST(PlantScorer, APenaltyTellsByHowMuchTheBudgetWasExceeded) {
  for (const double factor : {1.5, 10.0, 1e6}) {
    const double told = over_budget_factor(over_budget_penalty(factor));
    EXPECT_NEAR(told, factor, 1e-9 * factor);
  }
}

TEST(PlantScorer, ReportsAFailureOfTheModelFromAnyThread) {
  const PoleModel model;
  auto poles = some_poles();
  poles[17][0] = 13;
  EXPECT_THROW(scores_of(pole_task(model), poles, 2), std::runtime_error);
}

TEST(PlantScorer, OnceForgivingACandidateThatFailsIsTheWorstAndTheFirstReasonIsKept) {
  const PoleModel model;
  const FitTask task = pole_task(model, {1, 2});
  auto poles = some_poles();
  poles[3][0] = poles[17][0] = 14;
  PlantScorer scorer(task, 2);
  std::vector<double> scores(poles.size());
  EXPECT_THROW(scorer.score(poles, scores), InputError);
  EXPECT_EQ(scorer.failures().count, 0);
  scorer.score_failures_as_worst();
  scorer.score(poles, scores);
  for (std::size_t i = 0; i < scores.size(); ++i) EXPECT_EQ(scores[i] == kFailedCandidate, i == 3 || i == 17);
  EXPECT_GT(kFailedCandidate, over_budget_penalty(1e300));
  EXPECT_EQ(scorer.failures().count, 2);
  EXPECT_EQ(scorer.failures().first, "fourteen metres");
  poles[5][0] = 13;  // no bad input, but a failure of the program
  EXPECT_THROW(scorer.score(poles, scores), std::runtime_error);
}

}  // namespace
}  // namespace espalier
