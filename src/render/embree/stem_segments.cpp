// Segments of stems as primitives of Embree: one round Bézier curve a segment, or a chain of cones.
// Metres. The number of cones follows from two bounds on a cubic curve cut into n equal parts: the chord
// deviates by at most max|B''|/(8n²), and at a joint that turns by an angle a the surfaces gap by
// r·a/2, with a ≤ (turn of the whole curve)/n.
#include <algorithm>
#include <cmath>

#include <espalier/render/embree/embree_geometry.h>

namespace espalier {

namespace {

using ControlPoint = StemSegments::ControlPoint;

constexpr float kShortestSegmentM = 1e-6f;
constexpr float kLargestCoordinateM = 1e9f;
constexpr int kMostCones = 32;

/// A segment with its radius at both ends.
struct Segment {
  Vec3 p0, p1, p2, p3;
  float r0, r1;
};

bool is_usable(Vec3 p) {
  return std::fabs(p.x) < kLargestCoordinateM && std::fabs(p.y) < kLargestCoordinateM &&
         std::fabs(p.z) < kLargestCoordinateM;
}

bool is_usable(const Segment& s) {
  return is_usable(s.p0) && is_usable(s.p1) && is_usable(s.p2) && is_usable(s.p3) &&
         s.r0 < kLargestCoordinateM && s.r1 < kLargestCoordinateM && std::max(s.r0, s.r1) > 0 &&
         length(s.p3 - s.p0) > kShortestSegmentM;
}

/// A handle on top of its knot has no direction: it moves a third of the way to the other knot.
Vec3 usable_handle(Vec3 handle, Vec3 knot, Vec3 other_knot) {
  return length(handle - knot) > kShortestSegmentM ? handle : lerp(knot, other_knot, 1.0f / 3);
}

/// The segment between knots k and k + 1.
Segment segment_at(const Knots& knots, std::size_t k) {
  const Vec3 from = knots.point_m[k], to = knots.point_m[k + 1];
  return {from,
          usable_handle(knots.handle_out_m[k], from, to),
          usable_handle(knots.handle_in_m[k + 1], to, from),
          to,
          std::max(0.0f, knots.radius_m[k]),
          std::max(0.0f, knots.radius_m[k + 1])};
}

ControlPoint control_point(Vec3 p, float radius) { return {p.x, p.y, p.z, radius}; }

Vec3 point_at(const Segment& s, float t) {
  const float u = 1 - t;
  return u * u * u * s.p0 + 3 * u * u * t * s.p1 + 3 * u * t * t * s.p2 + t * t * t * s.p3;
}

/// An upper bound of the angle between the directions at both ends, along the control polygon.
float turn_radians(const Segment& s) {
  const Vec3 a = normalized(s.p1 - s.p0), b = normalized(s.p2 - s.p1, a), c = normalized(s.p3 - s.p2, b);
  // A chord of the unit circle; its angle is at most π/2 times as long.
  return 0.5f * 3.1415927f * (length(b - a) + length(c - b));
}

/// How many cones keep deviation and gaps within `tolerance_m`.
int cones_of(const Segment& s, float tolerance_m) {
  const float second_derivative =
      6 * std::max(length(s.p0 - s.p1 * 2.0f + s.p2), length(s.p1 - s.p2 * 2.0f + s.p3));
  const float for_deviation = std::sqrt(second_derivative / (8 * tolerance_m));
  const float for_gaps = std::max(s.r0, s.r1) * turn_radians(s) / (2 * tolerance_m);
  return static_cast<int>(std::ceil(std::clamp(std::max(for_deviation, for_gaps), 1.0f, float{kMostCones})));
}

void push_curve(StemSegments& out, const Segment& s, std::size_t knot) {
  out.first_control_point.push_back(static_cast<std::uint32_t>(out.control_points.size()));
  out.knot.push_back(static_cast<std::uint32_t>(knot));
  out.control_points.push_back(control_point(s.p0, s.r0));
  out.control_points.push_back(control_point(s.p1, s.r0 + (s.r1 - s.r0) / 3));
  out.control_points.push_back(control_point(s.p2, s.r1 + (s.r0 - s.r1) / 3));
  out.control_points.push_back(control_point(s.p3, s.r1));
}

/// Appends cones to the chain that ends at the last control point.
void push_cones(StemSegments& out, const Segment& s, std::size_t knot, int count) {
  for (int i = 1; i <= count; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(count);
    out.first_control_point.push_back(static_cast<std::uint32_t>(out.control_points.size() - 1));
    out.knot.push_back(static_cast<std::uint32_t>(knot));
    out.neighbours.push_back(RTC_CURVE_FLAG_NEIGHBOR_LEFT | RTC_CURVE_FLAG_NEIGHBOR_RIGHT);
    out.control_points.push_back(control_point(i < count ? point_at(s, t) : s.p3, s.r0 + t * (s.r1 - s.r0)));
  }
}

constexpr auto kNotLeft = static_cast<std::uint8_t>(~unsigned{RTC_CURVE_FLAG_NEIGHBOR_LEFT});
constexpr auto kNotRight = static_cast<std::uint8_t>(~unsigned{RTC_CURVE_FLAG_NEIGHBOR_RIGHT});

void collect_curves(StemSegments& out, const Knots& knots, std::size_t begin, std::size_t end) {
  for (std::size_t k = begin; k + 1 < end; ++k)
    if (const Segment segment = segment_at(knots, k); is_usable(segment)) push_curve(out, segment, k);
}

/// A chain breaks, with caps, where a segment is left out.
void collect_cones(StemSegments& out, const Knots& knots, std::size_t begin, std::size_t end,
                   float tolerance_m) {
  bool in_chain = false;
  for (std::size_t k = begin; k + 1 < end; ++k) {
    const Segment segment = segment_at(knots, k);
    const bool usable = is_usable(segment);
    if (in_chain && !usable) out.neighbours.back() &= kNotRight;
    if (usable && !in_chain) out.control_points.push_back(control_point(segment.p0, segment.r0));
    const std::size_t first = out.neighbours.size();
    if (usable) push_cones(out, segment, k, cones_of(segment, tolerance_m));
    if (usable && !in_chain) out.neighbours[first] &= kNotLeft;
    in_chain = usable;
  }
  if (in_chain) out.neighbours.back() &= kNotRight;
}

}  // namespace

void StemSegments::collect(const Plant& plant, StemSurface surface, float tolerance_m) {
  control_points.clear();
  first_control_point.clear();
  neighbours.clear();
  knot.clear();
  for (std::size_t stem = 0; stem < plant.stems.size(); ++stem) {
    const std::size_t begin = plant.stems.first_knot[stem], end = plant.stems.first_knot[stem + 1];
    if (surface == StemSurface::cones)
      collect_cones(*this, plant.knots, begin, end, tolerance_m);
    else
      collect_curves(*this, plant.knots, begin, end);
  }
}

void StemSegments::set_on(RTCGeometry geometry) const {
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, control_points.data(), 0,
                             sizeof(ControlPoint), control_points.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, first_control_point.data(),
                             0, sizeof(std::uint32_t), first_control_point.size());
  if (!neighbours.empty())
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_FLAGS, 0, RTC_FORMAT_UCHAR, neighbours.data(), 0, 1,
                               neighbours.size());
}

}  // namespace espalier
