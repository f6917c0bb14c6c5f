#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <espalier/core/error.h>
#include <espalier/experiments/statistics/quantiles.h>

namespace espalier {
namespace {

const std::vector<double> kValues = {10, 1, 4, 2};  // sorted: 1 2 4 10

double at(const std::vector<double>& values, double p) { return quantile(values, p); }

TEST(Quantile, InterpolatesBetweenSortedValues) {  // positions 0.75, 1.5 and 2.25 of 0 … 3
  EXPECT_DOUBLE_EQ(at(kValues, 0.25), 1.75);
  EXPECT_DOUBLE_EQ(median(kValues), 3);
  EXPECT_DOUBLE_EQ(at(kValues, 0.75), 5.5);
}

TEST(Quantile, EndsAreTheSmallestAndTheLargest) {
  EXPECT_DOUBLE_EQ(at(kValues, 0), 1);
  EXPECT_DOUBLE_EQ(at(kValues, 1), 10);
}

TEST(Quantile, OfOneValueIsThatValue) { EXPECT_DOUBLE_EQ(at({7}, 0.3), 7); }

TEST(Quantile, OfNothingIsNoNumber) { EXPECT_TRUE(std::isnan(at({}, 0.5))); }

TEST(Quantile, ReachesAValueBesideAnInfiniteOne) {
  EXPECT_DOUBLE_EQ(at({1, 2, std::numeric_limits<double>::infinity()}, 0.5), 2);
}

TEST(Quantile, RefusesSharesOutsideZeroToOne) {
  EXPECT_THROW(at(kValues, -0.1), InternalError);
  EXPECT_THROW(at(kValues, 1.1), InternalError);
}

TEST(Quantile, RefusesWhatIsNoNumber) { EXPECT_THROW(at({1, std::nan("")}, 0.5), InternalError); }

RC_GTEST_PROP(Quantile, RisesWithItsShareAndStaysAmongTheValues, (std::vector<int> whole)) {
  RC_PRE(!whole.empty());
  const std::vector<double> values(whole.begin(), whole.end());
  double before = *std::min_element(values.begin(), values.end());
  for (int i = 0; i <= 10; ++i) {
    const double next = quantile(values, i / 10.0);
    RC_ASSERT(next >= before);
    before = next;
  }
  RC_ASSERT(before == *std::max_element(values.begin(), values.end()));
}

}  // namespace
}  // namespace espalier
