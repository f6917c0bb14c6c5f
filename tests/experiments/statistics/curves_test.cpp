#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <espalier/core/error.h>
#include <espalier/experiments/statistics/curves.h>

namespace espalier {
namespace {

using testing::ElementsAre;

const StepCurve kCurve = {{10, 20, 40}, {0.2, 0.5, 0.6}};

TEST(ValueAt, IsThatOfTheLastRowSoFar) {
  EXPECT_EQ(value_at(kCurve, 10), 0.2);
  EXPECT_EQ(value_at(kCurve, 19), 0.2);
  EXPECT_EQ(value_at(kCurve, 20), 0.5);
}

TEST(ValueAt, IsNothingBeforeTheFirstRow) {
  EXPECT_EQ(value_at(kCurve, 9), std::nullopt);
  EXPECT_EQ(value_at({}, 9), std::nullopt);
}

TEST(ValueAt, StaysAfterTheEnd) { EXPECT_EQ(value_at(kCurve, 1'000'000), 0.6); }

TEST(QuartileCurves, AreTheQuartilesOfTheStepsAtEachPoint) {
  const std::vector<StepCurve> curves = {kCurve, {{10}, {0.4}}, {{10, 30}, {0, 1}}};
  const std::vector<long> grid = {10, 30};
  const auto rows = quartile_curves(curves, grid);  // 0 0.2 0.4 and 0.4 0.5 1
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_DOUBLE_EQ(rows[0].q25, 0.1);
  EXPECT_DOUBLE_EQ(rows[0].median, 0.2);
  EXPECT_DOUBLE_EQ(rows[0].q75, 0.3);
  EXPECT_DOUBLE_EQ(rows[1].q25, 0.45);
  EXPECT_DOUBLE_EQ(rows[1].median, 0.5);
  EXPECT_DOUBLE_EQ(rows[1].q75, 0.75);
}

TEST(QuartileCurves, CountTheCurvesThatHaveAValue) {
  const std::vector<StepCurve> curves = {kCurve, {{20}, {0.4}}, {}};
  const std::vector<long> grid = {5, 10, 20};
  const auto rows = quartile_curves(curves, grid);
  ASSERT_EQ(rows.size(), 2u);  // none at 5
  EXPECT_EQ(rows[0].evaluations, 10);
  EXPECT_EQ(rows[0].curves, 1u);
  EXPECT_EQ(rows[1].curves, 2u);
}

TEST(StepCurve, RefusesFallingFitness) {
  EXPECT_THROW(check_step_curve({{1, 2}, {0.5, 0.4}}), InternalError);
}
TEST(StepCurve, RefusesRepeatedEvaluations) {
  EXPECT_THROW(check_step_curve({{3, 3}, {0.5, 0.6}}), InternalError);
}
TEST(StepCurve, RefusesColumnsOfDifferentLengths) {
  EXPECT_THROW(check_step_curve({{1}, {}}), InternalError);
}

TEST(LogGrid, SpacesWholeNumbersEvenlyInTheirLogarithm) {
  EXPECT_THAT(log_grid(1000, 4), ElementsAre(1, 10, 100, 1000));
}

TEST(LogGrid, LeavesOutNumbersThatWouldRepeat) { EXPECT_THAT(log_grid(3, 50), ElementsAre(1, 2, 3)); }

TEST(LogGrid, OfOneEvaluationIsOnePoint) { EXPECT_THAT(log_grid(1, 10), ElementsAre(1)); }

RC_GTEST_PROP(LogGrid, RisesFromOneToTheLast, ()) {
  const long last = *rc::gen::inRange(1, 1'000'000);
  const auto grid = log_grid(last, static_cast<std::size_t>(*rc::gen::inRange(2, 300)));
  RC_ASSERT(grid.front() == 1);
  RC_ASSERT(grid.back() == last);
  for (std::size_t i = 1; i < grid.size(); ++i) RC_ASSERT(grid[i] > grid[i - 1]);
}

}  // namespace
}  // namespace espalier
