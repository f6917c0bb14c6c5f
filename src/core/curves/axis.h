// A curve in space as a few points: a clamped uniform cubic B-spline (de Boor, A Practical Guide to Splines,
// ch. IX) that begins at the origin. It is linear in its points, so that it is fitted to a line by least
// squares, and the splines of 3 points after the base are among those of 4, these among those of 6, and these
// among those of 10. Of what size it is drawn matters to nobody who asks for shares of its length.
#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace espalier {

struct AxisPoint {
  double x = 0, y = 0, z = 0;
};

inline AxisPoint operator+(AxisPoint a, AxisPoint b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline AxisPoint operator-(AxisPoint a, AxisPoint b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline AxisPoint operator*(AxisPoint a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline bool operator==(AxisPoint a, AxisPoint b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
double length(AxisPoint a);

inline constexpr std::size_t kAxisPoints = 11;  ///< with the base

/// How many points may be given after the base.
inline constexpr std::array<std::size_t, 4> kAxisCounts{3, 4, 6, 10};

struct AxisCurve {
  std::array<AxisPoint, kAxisPoints> points{};  ///< the first is the origin
};

/// The axis of 3, 4, 6 or 10 points after the base, refined to 10 without a change. Throws InputError for
/// other counts, for a coordinate that is not within 1000 of 0, and for points that are all the same.
AxisCurve make_axis(std::span<const AxisPoint> after_base);

/// The place at u in [0, 1], and the derivative there.
AxisPoint axis_point(const AxisCurve& axis, double u);
AxisPoint axis_slope(const AxisCurve& axis, double u);

/// An axis by its length. Valid as long as the axis.
class AxisArcs {
 public:
  explicit AxisArcs(const AxisCurve& axis);
  double length() const { return at_.back(); }
  /// Where u is at a share of the length, 0 to 1.
  double place_at(double share) const;
  /// The unit vector along the axis at u.
  AxisPoint direction(double u) const;

 private:
  static constexpr std::size_t kParts = 4 * (kAxisPoints - 3);
  const AxisCurve* axis_;
  std::array<double, kParts + 1> at_{};  ///< length up to the end of each part of [0, 1]
};

/// The `count` points after the base, one of kAxisCounts, of the axis that is nearest to the line by least
/// squares. The line's points belong to evenly spaced u from 0 to 1; the base is the origin, and not the
/// line's first point. Expects more points of the line than `count`.
std::vector<AxisPoint> fit_axis(std::span<const AxisPoint> line, std::size_t count);

}  // namespace espalier
