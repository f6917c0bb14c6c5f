#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include <espalier/core/curves/axis.h>
#include <espalier/core/curves/de_boor.h>
#include <espalier/core/error.h>

namespace espalier {

/// For de_boor(), which finds it by its argument.
static AxisPoint between(AxisPoint a, AxisPoint b, double share) { return a * (1 - share) + b * share; }

namespace {

constexpr std::size_t kAxisDegree = 3;
constexpr double kFarthest = 1000;  ///< coordinate of a point

/// Knot i of the clamped uniform spline of so many points.
double axis_knot(std::size_t i, std::size_t points) {
  const auto pieces = static_cast<double>(points - kAxisDegree);
  return std::clamp((static_cast<double>(i) - static_cast<double>(kAxisDegree)) / pieces, 0.0, 1.0);
}

std::size_t axis_piece(double u, std::size_t points) {
  const std::size_t pieces = points - kAxisDegree;
  return std::min(static_cast<std::size_t>(std::max(0.0, u) * static_cast<double>(pieces)), pieces - 1);
}

template <typename Value>
Value spline_at(std::span<const Value> points, double u) {
  const auto knot = [&](std::size_t i) { return axis_knot(i, points.size()); };
  return de_boor(points, knot, kAxisDegree, axis_piece(u, points.size()), u);
}

/// The uniform spline with each piece cut in two (Boehm 1980): knots are put in one by one.
std::vector<AxisPoint> with_halved_pieces(const std::vector<AxisPoint>& coarse) {
  std::vector<AxisPoint> points = coarse;
  std::vector<double> knots(coarse.size() + kAxisDegree + 1);
  for (std::size_t i = 0; i < knots.size(); ++i) knots[i] = axis_knot(i, coarse.size());
  const std::size_t pieces = coarse.size() - kAxisDegree;
  for (std::size_t piece = 0; piece < pieces; ++piece) {
    const double knot = (static_cast<double>(piece) + 0.5) / static_cast<double>(pieces);
    const std::size_t k = kAxisDegree + 2 * piece;  // the knot before it
    std::vector<AxisPoint> refined(points.begin(),
                                   points.begin() + static_cast<std::ptrdiff_t>(2 * piece + 1));
    refined.reserve(points.size() + 1);
    for (std::size_t i = k - kAxisDegree + 1; i <= k; ++i)
      refined.push_back(
          between(points[i - 1], points[i], (knot - knots[i]) / (knots[i + kAxisDegree] - knots[i])));
    refined.insert(refined.end(), points.begin() + static_cast<std::ptrdiff_t>(k), points.end());
    points = std::move(refined);
    knots.insert(knots.begin() + static_cast<std::ptrdiff_t>(k + 1), knot);
  }
  return points;
}

void check_axis(std::span<const AxisPoint> points) {
  if (std::find(kAxisCounts.begin(), kAxisCounts.end(), points.size()) == kAxisCounts.end())
    throw_input_error("got {} points of an axis, expected 3, 4, 6 or 10 after its base", points.size());
  for (const AxisPoint& point : points)
    for (const double number : {point.x, point.y, point.z})
      if (!(std::fabs(number) <= kFarthest))
        throw_input_error("got the number {} of an axis, expected one from {:g} to {:g}", number, -kFarthest,
                          kFarthest);
  if (std::all_of(points.begin(), points.end(), [&](const AxisPoint& p) { return p == points[0]; }))
    throw_input_error("got points of an axis that are all the same, expected a curve");
}

}  // namespace

double length(AxisPoint a) { return std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z); }

AxisCurve make_axis(std::span<const AxisPoint> after_base) {
  check_axis(after_base);
  std::vector<AxisPoint> points{{}};
  points.insert(points.end(), after_base.begin(), after_base.end());
  while (points.size() < kAxisPoints) points = with_halved_pieces(points);
  AxisCurve axis;
  std::copy(points.begin(), points.end(), axis.points.begin());
  return axis;
}

AxisPoint axis_point(const AxisCurve& axis, double u) {
  return spline_at(std::span<const AxisPoint>(axis.points), u);
}

AxisPoint axis_slope(const AxisCurve& axis, double u) {
  std::array<AxisPoint, kAxisPoints - 1> slopes;
  const auto knot = [](std::size_t i) { return axis_knot(i + 1, kAxisPoints); };
  for (std::size_t i = 0; i < slopes.size(); ++i)
    slopes[i] = (axis.points[i + 1] - axis.points[i]) * (kAxisDegree / (knot(i + kAxisDegree) - knot(i)));
  return de_boor(std::span<const AxisPoint>(slopes), knot, kAxisDegree - 1, axis_piece(u, kAxisPoints), u);
}

/// Gauss's rule of three points in each part: of polynomials up to the fifth degree it is exact.
AxisArcs::AxisArcs(const AxisCurve& axis) : axis_(&axis) {
  constexpr double kOff = 0.7745966692414834;  // the square root of 3/5
  constexpr double kPart = 1.0 / kParts;
  for (std::size_t i = 0; i < kParts; ++i) {
    const auto speed = [&](double off) {
      return espalier::length(axis_slope(*axis_, (static_cast<double>(i) + 0.5 + off / 2) * kPart));
    };
    at_[i + 1] = at_[i] + (5 * speed(-kOff) + 8 * speed(0) + 5 * speed(kOff)) / 18 * kPart;
  }
}

double AxisArcs::place_at(double share) const {
  const double wanted = share * length();
  const auto end = std::upper_bound(at_.begin() + 1, at_.end() - 1, wanted);
  const auto part = static_cast<std::size_t>(end - at_.begin()) - 1;
  const double of_part = at_[part + 1] > at_[part] ? (wanted - at_[part]) / (at_[part + 1] - at_[part]) : 0;
  return std::clamp((static_cast<double>(part) + of_part) / kParts, 0.0, 1.0);
}

/// Where points lie on each other the curve stands still: its direction is that of what is around.
AxisPoint AxisArcs::direction(double u) const {
  const double least = 1e-6 * length();
  AxisPoint along = axis_slope(*axis_, u);
  for (double around = 1.0 / 64; espalier::length(along) < least && around < 1; around *= 2)
    along = axis_point(*axis_, std::min(1.0, u + around)) - axis_point(*axis_, std::max(0.0, u - around));
  const double norm = espalier::length(along);
  return norm > 0 ? along * (1 / norm) : AxisPoint{0, 0, 1};
}

std::vector<AxisPoint> fit_axis(std::span<const AxisPoint> line, std::size_t count) {
  ESPALIER_CHECK_EQ(line.size() > count, true);
  const auto unknowns = static_cast<Eigen::Index>(count);
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(unknowns, unknowns);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(unknowns, 3);
  std::vector<double> basis(count + 1);
  Eigen::VectorXd weights(unknowns);
  for (std::size_t s = 0; s < line.size(); ++s) {
    const double u = static_cast<double>(s) / static_cast<double>(line.size() - 1);
    for (std::size_t i = 0; i < count; ++i) {
      basis[i + 1] = 1;
      weights[static_cast<Eigen::Index>(i)] = spline_at(std::span<const double>(basis), u);
      basis[i + 1] = 0;
    }
    normal += weights * weights.transpose();
    right += weights * Eigen::RowVector3d(line[s].x, line[s].y, line[s].z);
  }
  const Eigen::MatrixXd solved = normal.ldlt().solve(right);
  std::vector<AxisPoint> points;
  points.reserve(count);
  for (Eigen::Index i = 0; i < unknowns; ++i) points.push_back({solved(i, 0), solved(i, 1), solved(i, 2)});
  return points;
}

}  // namespace espalier
