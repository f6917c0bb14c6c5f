// A function of one variable on [0, 1] as a few numbers: a clamped uniform cubic B-spline (de Boor, A
// Practical Guide to Splines, ch. IX). It is linear in its numbers, so that blends and searches of functions
// are those of numbers, and lies between their least and their largest. The numbers stand at the Greville
// abscissae, for which the spline of x is x: no root is sought. Splines of 4 numbers are among those of 5,
// and these among those of 7.
#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace espalier {

inline constexpr std::size_t kCurveNumbers = 7;

struct Curve {
  std::array<double, kCurveNumbers> numbers{};
};

/// How many numbers may be given of a function.
inline constexpr std::array<std::size_t, 4> kCurveCounts{1, 4, 5, 7};

/// The function of 1, 4, 5 or 7 numbers: one is a constant, 4 and 5 are refined without a change (Boehm's
/// insertion of knots). Throws InputError for other counts and for a number that is not finite.
Curve make_curve(std::span<const double> numbers);

/// Its value; before 0 and after 1 that of the end. NaN where x is.
double curve_value(const Curve& curve, double x);

/// Its derivative in [0, 1]; 0 before and after, because the value stays. NaN where x is.
double curve_slope(const Curve& curve, double x);

/// Where the numbers of a function of so many stand, from 0 to 1: at 0 for a single one.
std::vector<double> curve_abscissae(std::size_t count);

/// The curve that begins and ends as these values at evenly spaced places from 0 to 1 do, and is nearest to
/// them in between by least squares. Expects at least 8 values.
Curve fit_curve(std::span<const double> values);

}  // namespace espalier
