// Laws of functions by a few numbers: a cubic B-spline that is linear in them and stays between them.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include <espalier/core/curves/curve.h>
#include <espalier/core/error.h>

namespace espalier {
namespace {

std::vector<double> random_numbers(std::size_t count) {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < count; ++i) numbers.push_back(*rc::gen::inRange(-1000, 1001) * 1e-3);
  return numbers;
}
double random_place() { return *rc::gen::inRange(0, 1000001) * 1e-6; }

/// The cubic in Bernstein's form, which a spline of 4 numbers is.
double bernstein(std::span<const double> c, double x) {
  const double s = 1 - x;
  return s * s * s * c[0] + 3 * s * s * x * c[1] + 3 * s * x * x * c[2] + x * x * x * c[3];
}

/// The Cox-de Boor recursion by its definition.
double basis(std::span<const double> knots, std::size_t i, std::size_t degree, double x) {
  if (degree == 0) return knots[i] <= x && x < knots[i + 1] ? 1 : 0;
  double sum = 0;
  if (knots[i + degree] > knots[i])
    sum += (x - knots[i]) / (knots[i + degree] - knots[i]) * basis(knots, i, degree - 1, x);
  if (knots[i + degree + 1] > knots[i + 1])
    sum += (knots[i + degree + 1] - x) / (knots[i + degree + 1] - knots[i + 1]) *
           basis(knots, i + 1, degree - 1, x);
  return sum;
}

RC_GTEST_PROP(Curve, OfFourNumbersIsTheirCubic, ()) {
  const std::vector<double> numbers = random_numbers(4);
  const double x = random_place();
  RC_ASSERT(std::fabs(curve_value(make_curve(numbers), x) - bernstein(numbers, x)) < 1e-14);
}

RC_GTEST_PROP(Curve, OfFiveAndSevenNumbersIsTheirBSpline, ()) {
  const bool five = *rc::gen::arbitrary<bool>();
  const std::vector<double> knots = five ? std::vector<double>{0, 0, 0, 0, 0.5, 1, 1, 1, 1}
                                         : std::vector<double>{0, 0, 0, 0, 0.25, 0.5, 0.75, 1, 1, 1, 1};
  const std::vector<double> numbers = random_numbers(five ? 5 : 7);
  const double x = std::min(random_place(), 1 - 1e-9);
  double expected = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) expected += numbers[i] * basis(knots, i, 3, x);
  RC_ASSERT(std::fabs(curve_value(make_curve(numbers), x) - expected) < 1e-13);
}

RC_GTEST_PROP(Curve, StaysBetweenItsNumbers, ()) {
  const std::vector<double> numbers = random_numbers(kCurveCounts[*rc::gen::inRange<std::size_t>(0, 4)]);
  const double value = curve_value(make_curve(numbers), random_place());
  RC_ASSERT(value >= *std::min_element(numbers.begin(), numbers.end()) - 1e-14);
  RC_ASSERT(value <= *std::max_element(numbers.begin(), numbers.end()) + 1e-14);
}

// Greville's identity: numbers that are the abscissae give x itself.
TEST(Curve, OfItsAbscissaeIsItsPlace) {
  for (const std::size_t count : {4u, 5u, 7u}) {
    const std::vector<double> abscissae = curve_abscissae(count);
    ASSERT_EQ(abscissae.size(), count);
    for (int i = 0; i <= 100; ++i)
      EXPECT_NEAR(curve_value(make_curve(abscissae), i / 100.0), i / 100.0, 1e-15);
  }
  EXPECT_EQ(curve_abscissae(1), std::vector<double>{0});
}

TEST(Curve, OfOneNumberIsIt) {
  const double number = 0.3;
  for (const double x : {0.0, 0.2, 1.0}) {
    EXPECT_DOUBLE_EQ(curve_value(make_curve({&number, 1}), x), 0.3);
    EXPECT_NEAR(curve_slope(make_curve({&number, 1}), x), 0, 1e-15);
  }
}

RC_GTEST_PROP(Curve, ItsSlopeIsItsDerivative, ()) {
  const Curve curve = make_curve(random_numbers(7));
  const double x = 0.001 + 0.998 * random_place(), h = 1e-6;
  const double expected = (curve_value(curve, x + h) - curve_value(curve, x - h)) / (2 * h);
  RC_ASSERT(std::fabs(curve_slope(curve, x) - expected) < 1e-3);
}

TEST(Curve, StaysAtItsEndsOutsideAndSaysNothingOfNothing) {
  const std::vector<double> numbers{2, 0, 5, 1, 4, 3, 7};
  const Curve curve = make_curve(numbers);
  EXPECT_EQ(curve_value(curve, -3), 2);
  EXPECT_EQ(curve_value(curve, 0), 2);
  EXPECT_EQ(curve_value(curve, 1), 7);
  EXPECT_EQ(curve_value(curve, 9), 7);
  EXPECT_EQ(curve_slope(curve, -3), 0);
  EXPECT_EQ(curve_slope(curve, 1), 3 * (7 - 3) / 0.25);
  EXPECT_TRUE(std::isnan(curve_value(curve, std::nan(""))));
  EXPECT_TRUE(std::isnan(curve_slope(curve, std::nan(""))));
}

TEST(Curve, OtherCountsAndNumbersThatAreNotFiniteAreRefused) {
  for (const std::size_t count : {0u, 2u, 3u, 6u, 8u})
    EXPECT_THROW(make_curve(std::vector<double>(count, 1)), InputError) << count;
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(make_curve(std::vector<double>{0, bad, 0, 0}), InputError);
}

RC_GTEST_PROP(Curve, IsFoundAgainByLeastSquares, ()) {
  const Curve curve = make_curve(random_numbers(7));
  std::vector<double> values;
  for (int i = 0; i <= 60; ++i) values.push_back(curve_value(curve, i / 60.0));
  const Curve fitted = fit_curve(values);
  for (std::size_t i = 0; i < kCurveNumbers; ++i)
    RC_ASSERT(std::fabs(fitted.numbers[i] - curve.numbers[i]) < 1e-10);
}

}  // namespace
}  // namespace espalier
