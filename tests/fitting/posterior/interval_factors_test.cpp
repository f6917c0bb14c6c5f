// What intervals are multiplied by so that they hold as many truths as they say: counted from ranks.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <espalier/fitting/posterior/interval_factors.h>
#include <espalier/fitting/posterior/normal_scores.h>

namespace espalier {
namespace {

/// Truths are standard normal; posteriors are centred normals, this much wider.
std::vector<double> shares_of_wide_posteriors(double width, int plants) {
  std::vector<double> shares;
  for (int i = 0; i < plants; ++i)
    shares.push_back(normal_share(normal_quantile((i + 0.5) / plants) / width));
  return shares;
}

TEST(IntervalFactors, BringWideAndNarrowIntervalsToTheirTruths) {
  for (const double width : {0.7, 0.9, 1.15, 1.4})
    for (const double factor : interval_factors(shares_of_wide_posteriors(width, 5000)))
      EXPECT_NEAR(factor, 1 / width, 0.02) << width;
}

TEST(IntervalFactors, EachIntervalHasItsOwn) {
  std::vector<double> shares = shares_of_wide_posteriors(1, 5000);
  for (double& share : shares)  // the middle half of the truths lies in a quarter of the draws
    if (std::fabs(share - 0.5) < 0.3) share = 0.5 + (share - 0.5) / 2;
  const IntervalFactors factors = interval_factors(shares);
  EXPECT_NEAR(factors[0], normal_quantile(0.625) / normal_quantile(0.75), 0.02);
  EXPECT_NEAR(factors[1], 1, 0.02);
  EXPECT_NEAR(factors[2], 1, 0.02);
}

/// Of 300 plants factors stray by .06 by counts alone.
TEST(IntervalFactors, ChanceChangesLittle) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  double squares = 0, unchanged = 0, counted = 0;
  for (int study = 0; study < 200; ++study) {
    std::vector<double> shares;
    for (int i = 0; i < 300; ++i) shares.push_back(normal_share(normal(random)));
    for (const double factor : interval_factors(shares)) {
      squares += (factor - 1) * (factor - 1);
      unchanged += factor == 1 ? 1 : 0;
      ++counted;
    }
  }
  EXPECT_LT(std::sqrt(squares / counted), 0.045);
  EXPECT_GT(unchanged / counted, 0.2);
}

TEST(IntervalFactors, AreOneWithoutPlantsAndFiniteWithTruthsBeyondAllDraws) {
  for (const double factor : interval_factors({})) EXPECT_EQ(factor, 1);
  for (const double factor : interval_factors(std::vector<double>(50, 1.0)))
    EXPECT_TRUE(std::isfinite(factor));
}

TEST(IntervalFactors, RunInLinesBetweenTheEndsOfIntervals) {
  const IntervalFactors factors = {0.8, 0.9, 1.1};
  const auto end = [](double share) { return normal_quantile(0.5 + share / 2); };
  EXPECT_EQ(factor_at(factors, 0), 0.8);
  EXPECT_NEAR(factor_at(factors, -end(0.5)), 0.8, 1e-12);
  EXPECT_NEAR(factor_at(factors, end(0.8)), 0.9, 1e-12);
  EXPECT_NEAR(factor_at(factors, -(end(0.8) + end(0.9)) / 2), 1, 1e-12);
  EXPECT_EQ(factor_at(factors, 3), 1.1);
}

}  // namespace
}  // namespace espalier
