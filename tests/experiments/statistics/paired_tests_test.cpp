// The signed-rank test against scipy 1.10 and against all signs counted one by one; Holm's correction by its
// definition; the bootstrap's interval by its laws.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include <espalier/core/error.h>
#include <espalier/experiments/statistics/paired_tests.h>
#include <espalier/experiments/statistics/quantiles.h>
#include <espalier/experiments/statistics/ranks.h>

namespace espalier {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

TEST(SignedRank, AgreesWithScipyWhereItIsExact) {
  const SignedRankTest test = signed_rank_test(std::vector{0.12, 0.05, -0.02, 0.30, 0.08, -0.01, 0.22, 0.15});
  EXPECT_EQ(test.pairs, 8u);
  EXPECT_EQ(test.statistic, 33);  // of 36: scipy gives the smaller sum, 3
  EXPECT_DOUBLE_EQ(test.p_value, 0.0390625);
  EXPECT_DOUBLE_EQ(signed_rank_test(std::vector<double>{1, 2, 3, 4, 5, 6}).p_value, 0.03125);
}

TEST(SignedRank, AgreesWithScipyByTheNormalDistribution) {
  std::vector<double> values;  // -1.1 … 2.8 with many sizes twice
  for (int i = 0; i < 40; ++i)
    if (i != 11) values.push_back(std::round(10 * (0.1 * i - 1.1)) / 10);
  const SignedRankTest test = signed_rank_test(values);
  EXPECT_EQ(test.pairs, 39u);
  EXPECT_NEAR(test.p_value, 0.00024192882503647217, 1e-12);
}

TEST(SignedRank, LeavesOutWhatIsEqual) {
  EXPECT_EQ(signed_rank_test(std::vector<double>{0, 1, 2, 0, 3}).pairs, 3u);
  EXPECT_EQ(signed_rank_test(std::vector<double>{0, 0}).p_value, 1);
  EXPECT_THROW(signed_rank_test(std::vector{1.0, std::nan("")}), InternalError);
}

/// Two-sided, by trying all signs.
double p_by_counting(const std::vector<double>& values) {
  std::vector<double> sizes;
  for (const double value : values) sizes.push_back(-std::fabs(value));
  const std::vector<double> ranks = average_ranks(sizes);
  double total = 0, positive = 0;
  for (std::size_t i = 0; i < ranks.size(); ++i) total += ranks[i], positive += values[i] > 0 ? ranks[i] : 0;
  const double distance = std::fabs(positive - total / 2);
  int as_far = 0;
  const int signs = 1 << ranks.size();
  for (int bits = 0; bits < signs; ++bits) {
    double sum = 0;
    for (std::size_t i = 0; i < ranks.size(); ++i) sum += (bits >> i) & 1 ? ranks[i] : 0;
    as_far += std::fabs(sum - total / 2) >= distance;
  }
  return double(as_far) / signs;
}

RC_GTEST_PROP(SignedRank, CountsAllSigns, ()) {
  std::vector<double> values;
  for (const int value :
       *rc::gen::container<std::vector<int>>(*rc::gen::inRange(1, 10), rc::gen::inRange(-5, 6)))
    if (value != 0) values.push_back(value);
  RC_PRE(!values.empty());
  RC_ASSERT(std::fabs(signed_rank_test(values).p_value - std::min(1.0, p_by_counting(values))) < 1e-12);
}

RC_GTEST_PROP(SignedRank, OfTheNegativesIsTheSame, ()) {
  std::vector<double> values, negated;
  for (const int value :
       *rc::gen::container<std::vector<int>>(*rc::gen::inRange(1, 60), rc::gen::inRange(-9, 10)))
    values.push_back(value), negated.push_back(-value);
  RC_ASSERT(std::fabs(signed_rank_test(values).p_value - signed_rank_test(negated).p_value) < 1e-12);
}

TEST(Holm, MultipliesTheSmallestMostAndKeepsTheOrder) {
  EXPECT_THAT(holm_adjusted(std::vector{0.01, 0.04, 0.03, 0.005}),
              ElementsAre(DoubleNear(0.03, 1e-12), DoubleNear(0.06, 1e-12), DoubleNear(0.06, 1e-12),
                          DoubleNear(0.02, 1e-12)));
  EXPECT_THAT(holm_adjusted(std::vector{0.9, 0.6}), ElementsAre(1, 1));
}

RC_GTEST_PROP(MedianInterval, HoldsTheMedianAndMovesWithIt, ()) {
  std::vector<double> values, moved;
  for (const int value :
       *rc::gen::container<std::vector<int>>(*rc::gen::inRange(3, 12), rc::gen::inRange(-9, 10)))
    values.push_back(value), moved.push_back(value + 100);
  const MedianInterval interval = median_interval(values, 0.95), other = median_interval(moved, 0.95);
  RC_ASSERT(interval.lower <= median(values) && median(values) <= interval.upper);
  RC_ASSERT(std::fabs(other.lower - interval.lower - 100) < 1e-9);
  RC_ASSERT(interval.lower >= *std::ranges::min_element(values));
  RC_ASSERT(interval.upper <= *std::ranges::max_element(values));
}

TEST(MedianInterval, IsWiderForMoreCoverageAndNaNWithoutValues) {
  const std::vector<double> values{1, 2, 3, 4, 5, 6, 7, 8, 9, 30};
  const MedianInterval wide = median_interval(values, 0.99), narrow = median_interval(values, 0.5);
  EXPECT_LT(wide.lower, narrow.lower);
  EXPECT_GT(wide.upper, narrow.upper);
  EXPECT_TRUE(std::isnan(median_interval({}, 0.9).lower));
}

}  // namespace
}  // namespace espalier
