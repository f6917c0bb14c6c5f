#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <espalier/core/error.h>
#include <espalier/experiments/statistics/rank_correlation.h>

namespace espalier {
namespace {

double rho(const std::vector<double>& a, const std::vector<double>& b) { return spearman_rho(a, b); }

TEST(SpearmanRho, IsOneWhereTheOrderIsTheSame) {
  EXPECT_DOUBLE_EQ(rho({3, 1, 2, 10}, {std::exp(3), std::exp(1), std::exp(2), std::exp(10)}), 1);
}

TEST(SpearmanRho, IsMinusOneWhereTheOrderIsReversed) { EXPECT_DOUBLE_EQ(rho({1, 2, 5}, {7, 0, -100}), -1); }

TEST(SpearmanRho, WithoutTiesIsTheFormulaOfSquaredDifferences) {  // 1 - 6·sum d² / n(n² - 1)
  EXPECT_DOUBLE_EQ(rho({1, 2, 3, 4, 5}, {2, 1, 4, 3, 5}), 1 - 6.0 * 4 / (5 * 24));
}

TEST(SpearmanRho, EqualValuesShareTheirMeanRank) {  // ranks 1, 2.5, 2.5, 4 and 1, 2, 3, 4: 4.5 / √(4.5·5)
  EXPECT_DOUBLE_EQ(rho({0, 6, 6, 9}, {1, 2, 3, 4}), 4.5 / std::sqrt(4.5 * 5));
}

TEST(SpearmanRho, IsNoNumberWhereNothingIsRanked) {
  EXPECT_TRUE(std::isnan(rho({2, 2, 2}, {1, 2, 3})));
  EXPECT_TRUE(std::isnan(rho({}, {})));
}

TEST(SpearmanRho, RefusesDifferentLengths) { EXPECT_THROW(rho({1, 2}, {1, 2, 3}), InternalError); }

}  // namespace
}  // namespace espalier
