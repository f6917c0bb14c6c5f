// A helix of half turns, each one cubic Bézier curve [CH §3.2.1: points b0..b3 for α = π/2].
#include <algorithm>

#include <espalier/weber_penn/scalar/helix.h>

namespace espalier {

namespace {

struct Helix {
  float pitch_m, radius_m;
  Vec3 axis, u, v;  ///< unit frame about the axis
};

Helix make_helix(const GrowingStem& stem, const WeberPennParameters& p) {
  const int segments = segment_count(p, stem.level);
  // [CH]: θ = 90 − |curve_v|; kept off 0, where the helix would be a flat circle of infinite radius.
  const float theta_deg = std::clamp(90 - std::fabs(p.curve_v[level_index(stem.level)]), 5.f, 90.f);
  const float pitch_jitter = 1 + 0.2f * draw_signed(stem.key, Draw::helix_pitch);
  const float radius_jitter = 1 + 0.2f * draw_signed(stem.key, Draw::helix_radius);
  Helix helix;
  helix.pitch_m = 2 * stem.length_m / static_cast<float>(segments) * pitch_jitter;  // [CH] p = 2L/m
  helix.radius_m =
      3 * helix.pitch_m / (16 * std::tan(radians(theta_deg))) * radius_jitter;  // [CH] r = 3p/(16 tan θ)
  StemTurtle frame = stem.turtle;
  frame.roll_right(360 * draw_unit(stem.key, Draw::helix_roll));
  helix.axis = frame.forward;
  helix.u = frame.right;
  helix.v = cross(frame.forward, frame.right);
  return helix;
}

/// Half turn `index` from `start_m`: b1, b2, b3 relative to b0, turned by 180° for every other one.
Segment half_turn(const Helix& helix, Vec3 start_m, int index) {
  const float sign = index % 2 == 0 ? 1.f : -1.f;
  const auto place = [&](float x, float y, float z) {
    return start_m + helix.u * (sign * x) + helix.v * (sign * y) + helix.axis * z;
  };
  const float r = helix.radius_m, p = helix.pitch_m;
  Segment segment;
  segment.start_m = start_m;
  segment.handle_out_m = place(4 * r / 3, 0, p / 4);
  segment.handle_in_m = place(4 * r / 3, 2 * r, p / 4);
  segment.end_m = place(0, 2 * r, p / 2);
  segment.helical = true;
  return segment;
}

}  // namespace

void walk_helix(const GrowingStem& stem, const WeberPennParameters& p, StemVisitor& visitor) {
  const int segments = segment_count(p, stem.level);
  const Helix helix = make_helix(stem, p);
  Vec3 position_m = stem.turtle.position_m;
  for (int index = 0; index < segments; ++index) {
    Segment segment = half_turn(helix, position_m, index);
    position_m = segment.end_m;
    segment.z_start = static_cast<float>(index) / static_cast<float>(segments);
    segment.z_end = static_cast<float>(index + 1) / static_cast<float>(segments);
    segment.end.position_m = position_m;
    segment.end.forward = normalized(segment.end_m - segment.handle_in_m, helix.axis);
    segment.end.right = normalized(cross(helix.axis, segment.end.forward), helix.u);
    if (!visitor.segment(stem, segment)) return;
  }
}

}  // namespace espalier
