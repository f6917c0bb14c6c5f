// The evaluator: counting, cutting, the first best, clamped values; and the small helpers beside it.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <espalier/fitting/optimizers/evaluator.h>
#include <espalier/fitting/optimizers/search_method.h>

#include "support/test_functions.h"

namespace espalier {
namespace {

using namespace test;

TEST(Evaluator, CutsTheLastBatchToTheBudget) {
  const Sphere sphere(1);
  const Budget budget{5};
  Trace trace;
  Evaluator evaluator(sphere, budget, trace);
  evaluator.evaluate(std::vector<double>{0.1, 0.2, 0.3});
  EXPECT_THROW(evaluator.evaluate(std::vector<double>{0.4, 0.5, 0.6}), StopSearch);
  EXPECT_EQ(trace.points, (std::vector<double>{0.1, 0.2, 0.3, 0.4, 0.5}));
  EXPECT_EQ(evaluator.result(StopReason::budget).evaluations, 5);
}

TEST(Evaluator, FirstOfEqualsStaysTheBest) {
  const Flat flat(1);
  const Budget budget;
  Observer silent;
  Evaluator evaluator(flat, budget, silent);
  evaluator.evaluate(std::vector<double>{0.7, 0.2});
  evaluator.evaluate(std::vector<double>{0.1});
  EXPECT_EQ(evaluator.result(StopReason::budget).best_point, std::vector<double>{0.7});
}

TEST(Evaluator, ValuesThatAreNotFiniteCountAsWorst) {
  const Holed holed(1);
  const Budget budget;
  Observer silent;
  Evaluator evaluator(holed, budget, silent);
  const std::vector<double> points = {0.1005, 0.1015, 0.1025, 0.1035};  // NaN, inf, -inf, a number
  const auto values = evaluator.evaluate(points);
  EXPECT_EQ(std::vector<double>(values.begin(), values.begin() + 3), std::vector<double>(3, kWorstValue));
  EXPECT_LT(values[3], 1);
}

TEST(Evaluator, AsksTheObserverBeforeEachBatchAndStopsBeforeEvaluating) {
  const Sphere sphere(1);
  const Budget budget;
  Trace trace(2);
  Evaluator evaluator(sphere, budget, trace);
  evaluator.evaluate(std::vector<double>{0.1, 0.2});
  EXPECT_THROW(evaluator.evaluate(std::vector<double>{0.3}), StopSearch);
  EXPECT_EQ(sphere.count(), 2);
}

RC_GTEST_PROP(ReflectIntoUnit, StaysInsideAndIsEvenWithPeriodTwo, ()) {
  const double x = *rc::gen::map(rc::gen::inRange(-5000, 5000), [](int i) { return i / 1024.0; });
  const double folded = reflect_into_unit(x);
  RC_ASSERT(folded >= 0);
  RC_ASSERT(folded <= 1);
  RC_ASSERT(reflect_into_unit(-x) == folded);
  RC_ASSERT(reflect_into_unit(x + 2) == folded);
  if (x >= 0 && x <= 1) RC_ASSERT(folded == x);
}

TEST(Ranked, SortsAndKeepsTheOrderOfTies) {
  EXPECT_EQ(ranked(std::vector<double>{2, 1, 2, 0, 1}), (std::vector<std::size_t>{3, 1, 4, 0, 2}));
}

TEST(RandomStream, NormalsHaveMeanZeroAndVarianceOne) {
  double sum = 0, squares = 0, fourths = 0;
  constexpr int kCount = 100000;
  RandomStream draws(root_key(3));
  for (int i = 0; i < kCount; ++i) {
    const double z = draws.normal();
    sum += z;
    squares += z * z;
    fourths += z * z * z * z;
  }
  EXPECT_NEAR(sum / kCount, 0, 5 / std::sqrt(kCount));
  EXPECT_NEAR(squares / kCount, 1, 5 * std::sqrt(2.0 / kCount));
  EXPECT_NEAR(fourths / kCount, 3, 5 * std::sqrt(96.0 / kCount));
}

TEST(RandomStream, BelowReachesEachNumberEquallyOften) {
  std::vector<int> counts(7);
  RandomStream draws(root_key(4));
  for (int i = 0; i < 70000; ++i) ++counts.at(draws.below(7));
  for (int count : counts) EXPECT_NEAR(count, 10000, 500);
}

TEST(RandomSearch, BatchSizeChangesNothing) {
  Trace one, many;
  const Optimizer& random_search = optimizer_by_name("random_search");
  random_search.minimize(Sphere(3), {{"batch", 1}}, Budget{100}, {}, 1, one);
  random_search.minimize(Sphere(3), {{"batch", 33}}, Budget{100}, {}, 1, many);
  EXPECT_EQ(one.points, many.points);
}

}  // namespace
}  // namespace espalier
