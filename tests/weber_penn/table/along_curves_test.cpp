// Curves as growth evaluates them: those of their numbers, and densities that keep what they spread.
#include <gtest/gtest.h>

#include <cmath>

#include <espalier/core/curves/curve.h>
#include <espalier/weber_penn/table/along_curves.h>

namespace espalier {
namespace {

constexpr std::array<double, 7> kNumbers{0.5, 2, 0, 3, 1, 1.5, 0.25};

double value_of(std::span<const double> numbers, double x) { return curve_value(make_curve(numbers), x); }

TEST(AlongCurve, IsTheCurveOfItsNumbers) {
  const AlongCurve along = make_along_curve(kNumbers, 1);
  ASSERT_FALSE(along.is_neutral);
  for (int i = 0; i <= 1000; ++i) EXPECT_NEAR(along.at(i * 1e-3f), value_of(kNumbers, i * 1e-3), 2e-6) << i;
}

TEST(AlongCurve, StaysAtItsEndsBeyondThem) {
  const AlongCurve along = make_along_curve(kNumbers, 1);
  EXPECT_EQ(along.at(-0.5f), along.at(0));
  EXPECT_EQ(along.at(1.5f), along.at(1));
}

/// On a stem without length a place is 0 / 0.
TEST(AlongCurve, OfNoNumberIsThatOfTheStart) {
  const AlongCurve along = make_along_curve(kNumbers, 1);
  EXPECT_EQ(along.at(NAN), along.at(0));
}

TEST(AlongCurve, OfOneNumberIsThatNumber) {
  const AlongCurve along = make_along_curve(make_curve(std::array{0.7}).numbers, 1);
  for (int i = 0; i <= 100; ++i) EXPECT_EQ(along.at(i * 1e-2f), 0.7f) << i;
}

TEST(AlongCurve, IsNeutralWhereAllNumbersAre) {
  EXPECT_TRUE(make_along_curve(std::array<double, 7>{1, 1, 1, 1, 1, 1, 1}, 1).is_neutral);
  EXPECT_FALSE(make_along_curve(std::array<double, 7>{1, 1, 1, 1, 1, 1, 1}, 0).is_neutral);
  EXPECT_FALSE(make_along_curve(std::array<double, 7>{1, 1, 1, 1, 1, 1, 1.1}, 1).is_neutral);
}

/// By the trapezium rule on a fine grid.
double share_of(std::span<const double> numbers, double x) {
  constexpr int kSteps = 4000;
  double below = 0, whole = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double at = (i + 0.5) / kSteps, value = value_of(numbers, at);
    whole += value;
    if (at < x) below += value;
  }
  return below / whole;
}

TEST(DensityCurve, SharesAreTheIntegralOfTheCurve) {
  const DensityCurve density = make_density_curve(kNumbers);
  ASSERT_FALSE(density.is_neutral);
  for (int i = 0; i <= 50; ++i)
    EXPECT_NEAR(density.share_below(i * 0.02f), share_of(kNumbers, i * 0.02), 1e-3);
  EXPECT_EQ(density.share_below(0), 0);
  EXPECT_EQ(density.share_below(1), 1);
}

TEST(DensityCurve, PlacesAreTheInverseOfShares) {
  const DensityCurve density = make_density_curve(kNumbers);
  for (int i = 0; i <= 100; ++i)
    EXPECT_NEAR(density.share_below(density.place_of(i * 0.01f)), i * 0.01f, 1e-6) << i;
}

TEST(DensityCurve, NothingIsPlacedWhereItIsZero) {
  const DensityCurve upper = make_density_curve(std::array<double, 7>{0, 0, 0, 0, 0, 1, 1});
  EXPECT_GE(upper.place_of(0), 0.25f);
  const DensityCurve lower = make_density_curve(std::array<double, 7>{1, 1, 0, 0, 0, 0, 0});
  EXPECT_LE(lower.place_of(1), 0.75f);
}

TEST(DensityCurve, OnlyRelativeValuesCount) {
  std::array<double, 7> tripled = kNumbers;
  for (double& number : tripled) number *= 3;
  const DensityCurve one = make_density_curve(kNumbers), three = make_density_curve(tripled);
  for (int i = 0; i <= 100; ++i) EXPECT_NEAR(one.place_of(i * 0.01f), three.place_of(i * 0.01f), 1e-6) << i;
  EXPECT_TRUE(make_density_curve(std::array<double, 7>{3, 3, 3, 3, 3, 3, 3}).is_neutral);
}

}  // namespace
}  // namespace espalier
