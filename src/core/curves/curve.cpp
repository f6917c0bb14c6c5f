#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include <espalier/core/curves/curve.h>
#include <espalier/core/curves/de_boor.h>
#include <espalier/core/error.h>

namespace espalier {

namespace {

constexpr std::size_t kDegree = 3;
constexpr std::size_t kPieces = kCurveNumbers - kDegree;
constexpr std::array<double, kCurveNumbers + kDegree + 1> kKnots{0, 0, 0, 0, 0.25, 0.5, 0.75, 1, 1, 1, 1};

/// A clamped cubic B-spline of any count of numbers.
struct Spline {
  std::vector<double> knots, numbers;
};

/// The same spline with one more knot (Boehm 1980).
Spline with_knot(const Spline& spline, double knot) {
  const auto& t = spline.knots;
  const auto after = std::upper_bound(t.begin(), t.end(), knot);
  const auto k = static_cast<std::size_t>(after - t.begin()) - 1;
  Spline refined{t, {}};
  refined.knots.insert(refined.knots.begin() + static_cast<std::ptrdiff_t>(k + 1), knot);
  for (std::size_t i = 0; i <= spline.numbers.size(); ++i) {
    const double share = i + kDegree <= k ? 1 : i > k ? 0 : (knot - t[i]) / (t[i + kDegree] - t[i]);
    const double own = share > 0 ? share * spline.numbers[i] : 0;
    refined.numbers.push_back(share < 1 ? own + (1 - share) * spline.numbers[i - 1] : own);
  }
  return refined;
}

std::size_t piece_of(double x) { return std::min(static_cast<std::size_t>(x * kPieces), kPieces - 1); }

}  // namespace

Curve make_curve(std::span<const double> numbers) {
  if (std::find(kCurveCounts.begin(), kCurveCounts.end(), numbers.size()) == kCurveCounts.end())
    throw_input_error("got {} numbers, expected 1, 4, 5 or 7 of a function", numbers.size());
  for (const double number : numbers)
    if (!std::isfinite(number))
      throw_input_error("got the number {} of a function, expected a finite one", number);
  Curve curve;
  if (numbers.size() == 1) {
    curve.numbers.fill(numbers[0]);
    return curve;
  }
  Spline spline{{0, 0, 0, 0, 1, 1, 1, 1}, {numbers.begin(), numbers.end()}};
  if (numbers.size() == 5) spline.knots = {0, 0, 0, 0, 0.5, 1, 1, 1, 1};
  if (numbers.size() == 4) spline = with_knot(spline, 0.5);
  if (spline.numbers.size() == 5) spline = with_knot(with_knot(spline, 0.25), 0.75);
  std::copy(spline.numbers.begin(), spline.numbers.end(), curve.numbers.begin());
  return curve;
}

double curve_value(const Curve& curve, double x) {
  if (std::isnan(x)) return x;
  const double inside = std::clamp(x, 0.0, 1.0);
  const auto knot = [](std::size_t i) { return kKnots[i]; };
  return de_boor(std::span<const double>(curve.numbers), knot, kDegree, piece_of(inside), inside);
}

double curve_slope(const Curve& curve, double x) {
  if (std::isnan(x)) return x;
  if (x < 0 || x > 1) return 0;
  std::array<double, kCurveNumbers - 1> slopes{};
  for (std::size_t i = 0; i < slopes.size(); ++i)
    slopes[i] =
        kDegree * (curve.numbers[i + 1] - curve.numbers[i]) / (kKnots[i + kDegree + 1] - kKnots[i + 1]);
  const auto knot = [](std::size_t i) { return kKnots[i + 1]; };
  return de_boor(std::span<const double>(slopes), knot, kDegree - 1, piece_of(x), x);
}

std::vector<double> curve_abscissae(std::size_t count) {
  if (count == 1) return {0};
  std::vector<double> abscissae;
  abscissae.reserve(count);
  const auto pieces = static_cast<double>(count - kDegree);
  const auto knot = [&](std::size_t i) {
    return std::clamp((static_cast<double>(i) - kDegree) / pieces, 0.0, 1.0);
  };
  for (std::size_t i = 0; i < count; ++i)
    abscissae.push_back((knot(i + 1) + knot(i + 2) + knot(i + 3)) / kDegree);
  return abscissae;
}

Curve fit_curve(std::span<const double> values) {
  constexpr std::size_t kInner = kCurveNumbers - 2;
  ESPALIER_CHECK_EQ(values.size() > kCurveNumbers, true);
  std::array<Curve, kCurveNumbers> basis;
  for (std::size_t i = 0; i < kCurveNumbers; ++i) basis[i].numbers[i] = 1;
  Eigen::Matrix<double, kInner, kInner> normal = Eigen::Matrix<double, kInner, kInner>::Zero();
  Eigen::Vector<double, kInner> right = Eigen::Vector<double, kInner>::Zero();
  for (std::size_t s = 0; s < values.size(); ++s) {
    const double x = static_cast<double>(s) / static_cast<double>(values.size() - 1);
    const double rest = values[s] - values.front() * curve_value(basis.front(), x) -
                        values.back() * curve_value(basis.back(), x);
    Eigen::Vector<double, kInner> weights;
    for (std::size_t i = 0; i < kInner; ++i) weights[static_cast<int>(i)] = curve_value(basis[i + 1], x);
    right += rest * weights;
    normal += weights * weights.transpose();
  }
  const Eigen::Vector<double, kInner> inner = normal.ldlt().solve(right);
  Curve curve;
  curve.numbers.front() = values.front();
  curve.numbers.back() = values.back();
  std::copy(inner.begin(), inner.end(), curve.numbers.begin() + 1);
  return curve;
}

}  // namespace espalier
