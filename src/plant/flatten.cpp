// Flattening by Wang's bound: n equal steps of a cubic stay within 6/8 · M / n² of it, where M is the
// largest second difference of its control points. Metres.
#include <algorithm>
#include <cmath>

#include <espalier/plant/flatten.h>

namespace espalier {

namespace {

constexpr float kSamePointM = 1e-6f;
constexpr float kMostSteps = 1024;

struct Segment {
  Vec3 p0, p1, p2, p3;
  float radius_0, radius_1;
};

Segment segment_at(const Knots& knots, std::size_t k) {
  return {knots.point_m[k],     knots.handle_out_m[k], knots.handle_in_m[k + 1],
          knots.point_m[k + 1], knots.radius_m[k],     knots.radius_m[k + 1]};
}

/// Goldman 2003, §5.6, for degree 3: n = sqrt(6/8 · M / tolerance).
int step_count(const Segment& s, float tolerance_m) {
  const float largest = std::max(length(s.p0 - 2 * s.p1 + s.p2), length(s.p1 - 2 * s.p2 + s.p3));
  const float steps = std::ceil(std::sqrt(0.75f * largest / tolerance_m));
  return static_cast<int>(std::clamp(steps, 1.0f, kMostSteps));
}

Vec3 point_on(const Segment& s, float t) {
  const Vec3 a = lerp(s.p0, s.p1, t), b = lerp(s.p1, s.p2, t), c = lerp(s.p2, s.p3, t);
  return lerp(lerp(a, b, t), lerp(b, c, t), t);
}

/// New points get the colour of the segment that leads to them.
void fill_colors(const Knots& knots, std::size_t segment, Polyline& polyline) {
  if (!knots.color.empty()) polyline.color.resize(polyline.size(), knots.color[segment]);
}

void append_point(Vec3 point_m, float radius_m, Polyline& polyline) {
  if (polyline.size() > 0 && length(point_m - polyline.point_m.back()) < kSamePointM) {
    polyline.radius_m.back() = radius_m;
    return;
  }
  polyline.point_m.push_back(point_m);
  polyline.radius_m.push_back(radius_m);
}

void append_segment(const Segment& s, float tolerance_m, Polyline& polyline) {
  const int steps = step_count(s, tolerance_m);
  for (int i = 1; i < steps; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(steps);
    append_point(point_on(s, t), s.radius_0 + (s.radius_1 - s.radius_0) * t, polyline);
  }
  append_point(s.p3, s.radius_1, polyline);
}

}  // namespace

void flatten_stem(const Plant& plant, std::size_t stem, float tolerance_m, Polyline& polyline) {
  polyline.point_m.clear();
  polyline.radius_m.clear();
  polyline.color.clear();
  const std::size_t first = plant.stems.first_knot[stem], end = plant.stems.first_knot[stem + 1];
  if (first == end) return;
  append_point(plant.knots.point_m[first], plant.knots.radius_m[first], polyline);
  fill_colors(plant.knots, first, polyline);
  for (std::size_t k = first; k + 1 < end; ++k) {
    append_segment(segment_at(plant.knots, k), tolerance_m, polyline);
    fill_colors(plant.knots, k, polyline);
  }
}

}  // namespace espalier
