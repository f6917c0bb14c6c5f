// Normal scores: places among others, and back.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <vector>

#include <espalier/fitting/posterior/normal_scores.h>

namespace espalier {
namespace {

TEST(NormalScores, OfAShareAreTheQuantilesOfTheNormalDistribution) {
  EXPECT_NEAR(normal_quantile(0.5), 0, 1e-12);
  EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-9);
  EXPECT_NEAR(normal_share(-1), 0.158655253931457, 1e-12);
}

RC_GTEST_PROP(NormalScores, RiseWithTheValuesAndLeadBackToThem, (std::vector<double> values)) {
  RC_PRE(values.size() >= 2);
  const NormalScores scores(values);
  for (const double a : values) {
    RC_ASSERT(scores.value(scores.score(a)) == a ||
              std::abs(scores.value(scores.score(a)) - a) <= 1e-9 * (1 + std::abs(a)));
    for (const double b : values) RC_ASSERT((a < b) == (scores.score(a) < scores.score(b)));
  }
}

TEST(NormalScores, OfEqualValuesAreTheMiddleOfTheirPlaces) {
  const NormalScores scores(std::vector<double>{1, 2, 2, 2, 3, 4, 4, 4});
  EXPECT_NEAR(scores.score(2), normal_quantile(2.5 / 8), 1e-12);
  EXPECT_NEAR(scores.score(2.5), normal_quantile(4.0 / 8), 1e-12);
}

TEST(NormalScores, NeverLeadBeyondTheValues) {
  const NormalScores scores(std::vector<double>{1, 2, 5});
  EXPECT_EQ(scores.value(9), 5);
  EXPECT_EQ(scores.value(-9), 1);
  EXPECT_NEAR(scores.value(normal_quantile(2.0 / 3)), 3.5, 1e-9);
  EXPECT_NEAR(scores.score(100), normal_quantile(2.5 / 3), 1e-12);
}

}  // namespace
}  // namespace espalier
