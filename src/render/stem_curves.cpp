// Segments of stems as round Bézier curves: four control points each, knots shared by neighbours. Metres.
#include <algorithm>
#include <cmath>

#include "render/embree_geometry.h"

namespace espalier {

namespace {

constexpr float kShortestSegmentM = 1e-6f;
constexpr float kLargestCoordinateM = 1e9f;

bool is_usable(const StemCurves::ControlPoint& p) {
  return std::fabs(p.x) < kLargestCoordinateM && std::fabs(p.y) < kLargestCoordinateM &&
         std::fabs(p.z) < kLargestCoordinateM && p.radius < kLargestCoordinateM && p.radius >= 0;
}

StemCurves::ControlPoint control_point(Vec3 p, float radius) { return {p.x, p.y, p.z, radius}; }

/// A handle on top of its knot has no direction: it moves a third of the way to the other knot.
Vec3 usable_handle(Vec3 handle, Vec3 knot, Vec3 other_knot) {
  return length(handle - knot) > kShortestSegmentM ? handle : lerp(knot, other_knot, 1.0f / 3);
}

/// The three points of a segment after its first; the segment's radius is linear along it.
void push_segment(StemCurves& curves, const Knots& knots, std::size_t k) {
  const Vec3 from = knots.point_m[k], to = knots.point_m[k + 1];
  const float r0 = std::max(0.0f, knots.radius_m[k]), r1 = std::max(0.0f, knots.radius_m[k + 1]);
  const Vec3 handle_out = usable_handle(knots.handle_out_m[k], from, to);
  const Vec3 handle_in = usable_handle(knots.handle_in_m[k + 1], to, from);
  curves.control_points.push_back(control_point(handle_out, r0 + (r1 - r0) / 3));
  curves.control_points.push_back(control_point(handle_in, r1 + (r0 - r1) / 3));
  curves.control_points.push_back(control_point(to, r1));
}

bool segment_is_usable(const StemCurves& curves, std::size_t first) {
  const auto& p = curves.control_points;
  for (std::size_t i = first; i < first + 4; ++i)
    if (!is_usable(p[i])) return false;
  const Vec3 chord{p[first + 3].x - p[first].x, p[first + 3].y - p[first].y, p[first + 3].z - p[first].z};
  return length(chord) > kShortestSegmentM && std::max(p[first].radius, p[first + 3].radius) > 0;
}

void collect_stem(StemCurves& curves, const Knots& knots, std::size_t begin, std::size_t end) {
  if (begin + 1 >= end) return;
  curves.control_points.push_back(control_point(knots.point_m[begin], std::max(0.0f, knots.radius_m[begin])));
  for (std::size_t k = begin; k + 1 < end; ++k) {
    const std::size_t first = curves.control_points.size() - 1;
    push_segment(curves, knots, k);
    if (!segment_is_usable(curves, first)) continue;
    curves.first_control_point.push_back(static_cast<std::uint32_t>(first));
    curves.first_knot.push_back(static_cast<std::uint32_t>(k));
  }
}

}  // namespace

void StemCurves::collect(const Plant& plant) {
  control_points.clear();
  first_control_point.clear();
  first_knot.clear();
  for (std::size_t stem = 0; stem < plant.stems.size(); ++stem)
    collect_stem(*this, plant.knots, plant.stems.first_knot[stem], plant.stems.first_knot[stem + 1]);
}

void StemCurves::set_on(RTCGeometry geometry) const {
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, control_points.data(), 0,
                             sizeof(ControlPoint), control_points.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, first_control_point.data(),
                             0, sizeof(std::uint32_t), first_control_point.size());
}

}  // namespace espalier
