#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numeric>

#include <espalier/core/error.h>
#include <espalier/experiments/statistics/ranks.h>

namespace espalier {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

const double kNaN = std::nan("");

std::vector<double> ranks(const std::vector<double>& values) { return average_ranks(values); }

std::vector<std::string> groups(const std::vector<double>& means, double difference) {
  return rank_groups(means, difference);
}

/// Demšar 2006, Table 6: AUC of C4.5, C4.5+m, C4.5+cf, C4.5+m+cf on 14 data sets. "Voting" is printed as
/// 0.975 twice with the ranks 2 and 3: its last digits differ, as here.
const BlockValues kDemsar = {
    {0.763, 0.768, 0.771, 0.798},   {0.599, 0.591, 0.590, 0.569}, {0.954, 0.971, 0.968, 0.967},
    {0.628, 0.661, 0.654, 0.657},   {0.882, 0.888, 0.886, 0.898}, {0.936, 0.931, 0.916, 0.931},
    {0.661, 0.668, 0.609, 0.685},   {0.583, 0.583, 0.563, 0.625}, {0.775, 0.838, 0.866, 0.875},
    {1.000, 1.000, 1.000, 1.000},   {0.940, 0.962, 0.965, 0.962}, {0.619, 0.666, 0.614, 0.669},
    {0.972, 0.981, 0.9752, 0.9748}, {0.957, 0.978, 0.946, 0.970}};

/// Hollander, Wolfe, Nonparametric Statistical Methods (1973), p. 140 ff.: seconds in which 22 players round
/// first base by three methods; also the example of R's friedman.test.
const BlockValues kFirstBase = {
    {5.40, 5.50, 5.55}, {5.85, 5.70, 5.75}, {5.20, 5.60, 5.50}, {5.55, 5.50, 5.40}, {5.90, 5.85, 5.70},
    {5.45, 5.55, 5.60}, {5.40, 5.40, 5.35}, {5.45, 5.50, 5.35}, {5.25, 5.15, 5.00}, {5.85, 5.80, 5.70},
    {5.25, 5.20, 5.10}, {5.65, 5.55, 5.45}, {5.60, 5.35, 5.45}, {5.05, 5.00, 4.95}, {5.50, 5.50, 5.40},
    {5.45, 5.55, 5.50}, {5.55, 5.55, 5.35}, {5.45, 5.50, 5.55}, {5.50, 5.45, 5.25}, {5.65, 5.60, 5.40},
    {5.70, 5.65, 5.55}, {6.30, 6.30, 6.25}};

TEST(AverageRanks, OneIsTheHighest) { EXPECT_THAT(ranks({0.1, 0.9, 0.5}), ElementsAre(3, 1, 2)); }

TEST(AverageRanks, EqualValuesShareTheMeanOfTheirRanks) {
  EXPECT_THAT(ranks({0.5, 0.9, 0.5, 0.5, 0.1}), ElementsAre(3, 1, 3, 3, 5));
}

TEST(AverageRanks, FailuresAreLastAndTied) {
  EXPECT_THAT(ranks({kNaN, -9, kNaN, 1}), ElementsAre(3.5, 2, 3.5, 1));
}

RC_GTEST_PROP(AverageRanks, SumToThatOfTheWholeNumbers, (std::vector<int> whole)) {
  const std::vector<double> values(whole.begin(), whole.end());
  const auto of_values = average_ranks(values);
  const double k = static_cast<double>(values.size());
  RC_ASSERT(std::accumulate(of_values.begin(), of_values.end(), 0.0) == k * (k + 1) / 2);
}

RC_GTEST_PROP(AverageRanks, DoNotChangeUnderARisingMap, (std::vector<signed char> whole)) {
  std::vector<double> values(whole.begin(), whole.end()), mapped;
  for (const double value : values) mapped.push_back(std::atan(value / 20) * 3 - 7);
  RC_ASSERT(average_ranks(values) == average_ranks(mapped));
}

TEST(MeanRanks, AreThoseOfDemsarsTable6) {
  EXPECT_THAT(mean_ranks(kDemsar), ElementsAre(DoubleNear(3.143, 5e-4), DoubleNear(2.000, 5e-4),
                                               DoubleNear(2.893, 5e-4), DoubleNear(1.964, 5e-4)));
}

TEST(MeanRanks, RefuseBlocksOfDifferentLengths) {
  EXPECT_THROW(mean_ranks({{1, 2}, {1, 2, 3}}), InternalError);
}
TEST(MeanRanks, RefuseNoBlocks) { EXPECT_THROW(mean_ranks({}), InternalError); }

TEST(Friedman, OfPlayersAtFirstBaseIsAsPublished) {  // R: chi-squared 11.1429, p 0.003805
  const FriedmanTest test = friedman_test(kFirstBase);
  EXPECT_NEAR(test.chi_squared, 11.142857, 1e-6);
  EXPECT_EQ(test.degrees_of_freedom, 2);
  EXPECT_NEAR(test.p_value, 0.003805, 5e-7);
  EXPECT_NEAR(test.p_value, std::exp(-test.chi_squared / 2),
              1e-14);  // closed form for two degrees of freedom
}

TEST(Friedman, WithoutItsCorrectionForTiesIsThatOfDemsar) {  // 9.28; three pairs and one four are tied
  const double correction = 1 - (3 * (8 - 2) + (64 - 4)) / (14.0 * (64 - 4));
  EXPECT_NEAR(friedman_test(kDemsar).chi_squared * correction, 9.28, 5e-3);
}

TEST(Friedman, FollowsImanAndDavenport) {
  const FriedmanTest test = friedman_test(kFirstBase);
  EXPECT_NEAR(test.iman_davenport_f, 21 * test.chi_squared / (22 * 2 - test.chi_squared), 1e-12);
  EXPECT_NEAR(test.iman_davenport_f, 7.121739, 1e-6);
  // closed form for 2 and 42 degrees of freedom: P(F > f) = (1 + f/21)^-21
  EXPECT_NEAR(test.iman_davenport_p, std::pow(1 + test.iman_davenport_f / 21, -21), 1e-14);
}

TEST(Friedman, DoesNotKnowWhichEndIsBetter) {
  BlockValues negated = kFirstBase;
  for (auto& block : negated)
    for (double& value : block) value = -value;
  EXPECT_NEAR(friedman_test(negated).chi_squared, friedman_test(kFirstBase).chi_squared, 1e-12);
}

TEST(Friedman, FindsNothingWhereAllIsTied) {
  const FriedmanTest test = friedman_test({{1, 1, 1}, {2, 2, 2}});
  EXPECT_EQ(test.chi_squared, 0);
  EXPECT_EQ(test.p_value, 1);
  EXPECT_EQ(test.iman_davenport_p, 1);
}

TEST(Friedman, IsSureWhereAllBlocksRankAlike) {  // chi-squared is N(k - 1), its largest value
  const FriedmanTest test = friedman_test({{1, 2, 3}, {4, 5, 6}, {1, 5, 9}});
  EXPECT_NEAR(test.chi_squared, 6, 1e-12);
  EXPECT_TRUE(std::isinf(test.iman_davenport_f));
  EXPECT_EQ(test.iman_davenport_p, 0);
}

TEST(Friedman, OfOneBlockHasNoF) { EXPECT_TRUE(std::isnan(friedman_test({{1, 2, 3}}).iman_davenport_f)); }

TEST(Nemenyi, QuantilesAreThoseOfDemsarsTable5) {  // made from a table of few decimals: right to 0.001
  const std::vector<double> at_05 = {1.960, 2.343, 2.569, 2.728, 2.850, 2.949, 3.031, 3.102, 3.164};
  const std::vector<double> at_10 = {1.645, 2.052, 2.291, 2.459, 2.589, 2.693, 2.780, 2.855, 2.920};
  for (std::size_t k = 2; k <= 10; ++k) {
    EXPECT_NEAR(nemenyi_quantile(k, 0.05), at_05[k - 2], 1e-3) << k;
    EXPECT_NEAR(nemenyi_quantile(k, 0.10), at_10[k - 2], 1e-3) << k;
  }
}

TEST(Nemenyi, QuantileOfTwoIsThatOfTheNormalDistribution) {
  EXPECT_NEAR(nemenyi_quantile(2, 0.05), 1.959963984540054, 1e-9);
}

TEST(Nemenyi, QuantilesRiseWithTheNumberOfTreatments) {
  for (std::size_t k = 3; k <= 100; ++k)
    EXPECT_GT(nemenyi_quantile(k, 0.05), nemenyi_quantile(k - 1, 0.05)) << k;
}

TEST(Nemenyi, CriticalDifferenceIsThatOfDemsarsExample) {  // section 3.2.2: 4 classifiers, 14 data sets, 1.25
  EXPECT_NEAR(nemenyi_critical_difference(4, 14), 1.25, 5e-3);
}

TEST(Nemenyi, RefusesASingleTreatment) { EXPECT_THROW(nemenyi_quantile(1, 0.05), InternalError); }
TEST(Nemenyi, RefusesNoBlocks) { EXPECT_THROW(nemenyi_critical_difference(4, 0), InternalError); }

TEST(RankGroups, OverlapWhereTheMiddleBelongsToBoth) {
  EXPECT_THAT(groups({1, 2, 3}, 1), ElementsAre("a", "ab", "b"));
}

TEST(RankGroups, AreNamedFromTheBestInTheGivenOrder) {
  EXPECT_THAT(groups({5, 1, 1.5, 9}, 1), ElementsAre("b", "a", "a", "c"));
}

TEST(RankGroups, HaveOneLetterWhereNothingDiffers) {
  EXPECT_THAT(groups({1, 3, 2}, 2), ElementsAre("a", "a", "a"));
}

TEST(RankGroups, GoOnAfterTheAlphabet) {
  std::vector<double> means(28);
  std::iota(means.begin(), means.end(), 1.0);
  EXPECT_EQ(groups(means, 0.5)[25], "z");
  EXPECT_EQ(groups(means, 0.5)[26], "a2");
  EXPECT_EQ(groups(means, 0.5)[27], "b2");
}

RC_GTEST_PROP(RankGroups, ShareALetterExactlyWhereTheDifferenceIsSmall, ()) {
  std::vector<double> means;
  for (int i = 0, count = *rc::gen::inRange(1, 20); i < count; ++i)
    means.push_back(*rc::gen::inRange(2, 40) / 2.0);
  const double difference = *rc::gen::inRange(0, 12) / 2.0;
  const auto letters = groups(means, difference);  // at most 20 groups: one character each
  for (std::size_t i = 0; i < means.size(); ++i)
    for (std::size_t j = 0; j < means.size(); ++j)
      RC_ASSERT((letters[i].find_first_of(letters[j]) != std::string::npos) ==
                (std::abs(means[i] - means[j]) <= difference));
}

}  // namespace
}  // namespace espalier
