// Curvature, tropism and dichotomous splits [CH §3.2.1; Weber & Penn 95, §4.1–4.2], see stem_walk.h.
#include "weber_penn/stem_walk.h"

#include <algorithm>

#include "weber_penn/helix.h"

namespace espalier {

namespace {

float curve_angle_deg(const GrowingStem& stem, int at, const WeberPennParameters& p) {
  const int level = level_index(stem.level);
  const int segments = segment_count(p, stem.level);
  const float jitter = draw_signed(stem.key, Draw::curve, at) * p.curve_v[level] / segments;
  if (p.curve_back[level] == 0) return p.curve[level] / segments + jitter;
  const bool first_half = 2 * at <= segments;
  return (first_half ? p.curve[level] : p.curve_back[level]) * 2 / segments + jitter;
}

/// Turns at segment end `at` where the stem does not split.
void turn(GrowingStem& stem, int at, const WeberPennParameters& p) {
  const int segments = segment_count(p, stem.level);
  const float bend_deg = draw_signed(stem.key, Draw::bend, at) * p.bend_v[level_index(stem.level)] / segments;
  stem.turtle.turn_left(bend_deg);
  stem.turtle.pitch_down(curve_angle_deg(stem, at, p) - stem.split_correction_deg);
}

/// Rotates the heading h by 10·|h × T| degrees about h × T; z pulls only at level 2 and above [CH §3.2.1].
void apply_tropism(GrowingStem& stem, const WeberPennParameters& p) {
  const Vec3 tropism{p.tropism_x, p.tropism_y, stem.level >= 2 ? p.tropism_z : 0};
  const Vec3 axis = cross(stem.turtle.forward, tropism);
  const float strength = length(axis);
  if (strength > 1e-9f) stem.turtle.rotate_about(axis * (1 / strength), 10 * strength);
}

struct SplitState {
  float error;  ///< of the error diffusion of seg_splits along this stem
};

bool is_base_split(const GrowingStem& stem, int at, const WeberPennParameters& p) {
  const int base_segment =
      std::max(1, static_cast<int>(std::ceil(p.base_size[0] * static_cast<float>(segment_count(p, 0)))));
  return stem.level == 0 && at == base_segment && p.base_splits != 0;
}

int base_split_count(const GrowingStem& stem, const WeberPennParameters& p) {
  if (p.base_splits > 0) return static_cast<int>(p.base_splits);
  return static_cast<int>(draw_unit(stem.key, Draw::base_splits) * (1 - p.base_splits));
}

/// Clones at an ordinary segment end, fractions diffused along the stem from a random start.
int diffused_split_count(const GrowingStem& stem, SplitState& state, int at, const WeberPennParameters& p) {
  const float rate = p.seg_splits[level_index(stem.level)];
  const bool above_base =
      stem.level > 0 || static_cast<float>(at) > std::ceil(p.base_size[0] * segment_count(p, 0));
  if (rate <= 0 || !above_base) return 0;
  if (draw_unit(stem.key, Draw::split_chance, at) > stem.clone_probability) return 0;
  const int count = static_cast<int>(rate + state.error);
  state.error += rate - static_cast<float>(count);
  return count;
}

/// Turns one of count + 1 clones, `index` 0 being the stem itself, away from the others.
void turn_clone(Turtle& turtle, int index, int count, float angle_deg, float spread_deg) {
  turtle.pitch_down(angle_deg / 2);
  turtle.rotate_about({0, 0, 1}, spread_deg * (static_cast<float>(index) / count - 0.5f));
}

/// split_angle < 0: all clones in the plane of the stem, not paid back.
void split_flat(GrowingStem& stem, int at, int count, const WeberPennParameters& p, StemVisitor& visitor) {
  const int level = level_index(stem.level);
  const float angle_deg =
      -p.split_angle[level] + draw_signed(stem.key, Draw::split_angle, at) * p.split_angle_v[level];
  const Turtle before = stem.turtle;
  stem.split_correction_deg = 0;
  for (int index = count; index >= 0; --index) {
    GrowingStem clone = stem;
    clone.turtle = before;
    clone.turtle.turn_right(angle_deg * (static_cast<float>(index) / count - 0.5f));
    if (index == 0)
      stem.turtle = clone.turtle;
    else
      clone.key = child_key(stem.key, 1'000'000u + 16u * at + index), visitor.split(clone);
  }
}

/// split_angle ≥ 0: clones lean away from the stem and are spread about the world's z axis; the angle is
/// paid back over the remaining segments [Weber & Penn 95, §4.2].
void split_round(GrowingStem& stem, int at, int count, bool at_base, const WeberPennParameters& p,
                 StemVisitor& visitor) {
  const int level = level_index(stem.level);
  const float declination = declination_deg(stem.turtle.forward);
  const float angle_deg =
      std::max(0.f, p.split_angle[level] +
                        draw_signed(stem.key, Draw::split_angle, at) * p.split_angle_v[level] - declination);
  const float u = draw_unit(stem.key, Draw::split_spread, at);
  const float spread_deg =
      at_base ? 360.f * count / (count + 1) : -(20 + 0.75f * (30 + std::fabs(declination - 90) * u * u));
  stem.split_correction_deg = angle_deg / static_cast<float>(segment_count(p, stem.level) - at);
  const Turtle before = stem.turtle;
  for (int index = count; index >= 0; --index) {
    GrowingStem clone = stem;
    clone.turtle = before;
    turn_clone(clone.turtle, index, count, angle_deg, spread_deg);
    if (index == 0)
      stem.turtle = clone.turtle;
    else
      clone.key = child_key(stem.key, 1'000'000u + 16u * at + index), visitor.split(clone);
  }
}

void split(GrowingStem& stem, int at, int count, bool at_base, const WeberPennParameters& p,
           StemVisitor& visitor) {
  stem.clone_probability /= static_cast<float>(count + 1);
  stem.branch_factor = std::max(0.8f, stem.branch_factor / static_cast<float>(count + 1));
  const int previous_first = stem.first_segment;
  stem.first_segment = at;
  if (p.split_angle[level_index(stem.level)] < 0)
    split_flat(stem, at, count, p, visitor);
  else
    split_round(stem, at, count, at_base, p, visitor);
  stem.first_segment = previous_first;
}

/// Moves the turtle by one segment, whose ends have handles of a third of its length along the heading.
Segment advance(GrowingStem& stem, Vec3 heading_at_start, int index, int segments) {
  const float segment_m = stem.length_m / static_cast<float>(segments);
  Segment segment;
  segment.start_m = stem.turtle.position_m;
  segment.handle_out_m = segment.start_m + heading_at_start * (segment_m / 3);
  stem.turtle.move(segment_m);
  segment.end_m = stem.turtle.position_m;
  segment.handle_in_m = segment.end_m - stem.turtle.forward * (segment_m / 3);
  segment.z_start = static_cast<float>(index) / static_cast<float>(segments);
  segment.z_end = static_cast<float>(index + 1) / static_cast<float>(segments);
  segment.end = stem.turtle;
  return segment;
}

}  // namespace

Vec3 segment_point(const Segment& s, float t) {
  const float u = 1 - t;
  return s.start_m * (u * u * u) + s.handle_out_m * (3 * u * u * t) + s.handle_in_m * (3 * u * t * t) +
         s.end_m * (t * t * t);
}

Vec3 segment_tangent(const Segment& s, float t) {
  const float u = 1 - t;
  const Vec3 derivative = (s.handle_out_m - s.start_m) * (u * u) +
                          (s.handle_in_m - s.handle_out_m) * (2 * u * t) +
                          (s.end_m - s.handle_in_m) * (t * t);
  return normalized(derivative, s.end.forward);
}

void walk_stem(GrowingStem stem, const WeberPennParameters& p, StemVisitor& visitor) {
  if (p.curve_v[level_index(stem.level)] < 0) return walk_helix(stem, p, visitor);
  const int segments = segment_count(p, stem.level);
  SplitState state{draw_unit(stem.key, Draw::split_error)};
  Vec3 heading = stem.turtle.forward;
  for (int index = stem.first_segment; index < segments; ++index) {
    const Segment segment = advance(stem, heading, index, segments);
    heading = stem.turtle.forward;
    if (!visitor.segment(stem, segment)) return;
    const int at = index + 1;
    if (at == segments) return;
    const bool at_base = is_base_split(stem, at, p);
    const int count = at_base ? base_split_count(stem, p) : diffused_split_count(stem, state, at, p);
    if (count > 0)
      split(stem, at, count, at_base, p, visitor);
    else
      turn(stem, at, p);
    apply_tropism(stem, p);
  }
}

}  // namespace espalier
