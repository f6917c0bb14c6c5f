// Curvature, tropism and dichotomous splits [CH §3.2.1; Weber & Penn 95, §4.1–4.2], see stem_walk.h.
#include <algorithm>

#include <espalier/weber_penn/scalar/axis_walk.h>
#include <espalier/weber_penn/scalar/helix.h>
#include <espalier/weber_penn/scalar/stem_walk.h>

namespace espalier {

namespace {

/// The variation at segment end `at`: up to `most` over the whole stem. No number is drawn where there is
/// nothing to vary.
float jitter_deg(const GrowingStem& stem, Draw purpose, int at, float most, int segments) {
  return most == 0 ? 0 : draw_signed(stem.key, purpose, at) * most / segments;
}

float curve_angle_deg(const GrowingStem& stem, int at, int segments, const WeberPennParameters& p) {
  const int level = level_index(stem.level);
  const float jitter = jitter_deg(stem, Draw::curve, at, p.curve_v[level], segments);
  const float factor = curve_factor(level, at, segments, p);
  if (p.curve_back[level] == 0) return (p.curve[level] / segments + jitter) * factor;
  const bool first_half = 2 * at <= segments;
  return ((first_half ? p.curve[level] : p.curve_back[level]) * 2 / segments + jitter) * factor;
}

/// Turns at segment end `at` where the stem does not split.
void turn(GrowingStem& stem, int at, const WeberPennParameters& p) {
  const int segments = segment_count(p, stem.level);
  const int level = level_index(stem.level);
  const float bend_deg =
      jitter_deg(stem, Draw::bend, at, p.bend_v[level], segments) + steady_bend_deg(level, at, segments, p);
  if (bend_deg != 0) stem.turtle.turn_left(bend_deg);
  const float back_deg = 2 * at > segments ? 2 * stem.extra_curve.back_deg : 0;
  const float extra_deg = (stem.extra_curve.whole_deg + back_deg) / static_cast<float>(segments);
  stem.turtle.pitch_down(curve_angle_deg(stem, at, segments, p) + extra_deg - stem.split_correction_deg);
}

/// Rotates the heading h by 10·|h × T| degrees about h × T; z pulls only at level 2 and above [CH §3.2.1].
void apply_tropism(GrowingStem& stem, const WeberPennParameters& p) {
  const Vec3 tropism{p.tropism_x, p.tropism_y, stem.level >= 2 ? p.tropism_z : 0};
  if (tropism == Vec3{}) return;
  const Vec3 axis = cross(stem.turtle.forward, tropism);
  const float strength = length(axis);
  if (strength > 1e-9f) stem.turtle.rotate_about(axis * (1 / strength), 10 * strength);
}

/// The first error of the error diffusion. Trunks start at 0 as in the published implementation, all else at
/// random, which keeps the mean while stems may grow in any order.
float first_split_error(const GrowingStem& stem) {
  return stem.level == 0 ? 0 : draw_unit(stem.key, Draw::split_error);
}

bool is_base_split(const GrowingStem& stem, int at, const WeberPennParameters& p) {
  const int base_segment =
      std::max(1, static_cast<int>(std::ceil(p.base_size[0] * static_cast<float>(segment_count(p, 0)))));
  return stem.level == 0 && at == base_segment && p.base_splits != 0;
}

int base_split_count(const GrowingStem& stem, const WeberPennParameters& p) {
  if (p.base_splits > 0) return static_cast<int>(p.base_splits);
  return static_cast<int>(draw_unit(stem.key, Draw::base_splits) * (1 - p.base_splits));
}

/// A chance to split leaves less for each part: further splits are less likely, and the rest of the stem
/// bears children at a rate that falls by the branch factor, which the clones inherit.
void thin_out(GrowingStem& stem, int count) {
  const float parts = static_cast<float>(count + 1);
  stem.clone_probability /= parts;
  stem.branch_factor = std::max(0.8f, stem.branch_factor / parts);
  stem.child_share *= stem.branch_factor;
}

/// Clones at an ordinary segment end, fractions diffused along the stem from a random start. The stem thins
/// out at every chance that is taken, also where no whole clone comes of it (the published implementation's
/// rule).
int diffused_split_count(GrowingStem& stem, int at, const WeberPennParameters& p) {
  const float rate = p.seg_splits[level_index(stem.level)];
  const bool above_base =
      stem.level > 0 || static_cast<float>(at) > std::ceil(p.base_size[0] * segment_count(p, 0));
  if (rate <= 0 || !above_base) return 0;
  if (draw_unit(stem.key, Draw::split_chance, at) > stem.clone_probability) return 0;
  const int count = static_cast<int>(rate + stem.split_error);
  stem.split_error += rate - static_cast<float>(count);
  thin_out(stem, count);
  return count;
}

/// How the parts of a split turn away from each other, in degrees.
struct Fork {
  float turn_deg = 0;        ///< between the outermost parts, in the plane of the stem
  float pitch_deg = 0;       ///< of each part
  float spread_deg = 0;      ///< between the outermost parts, about the world's z axis
  float correction_deg = 0;  ///< paid back at each later segment end
};

/// split_angle < 0: all parts in the plane of the stem, not paid back.
Fork flat_fork(const GrowingStem& stem, int at, const WeberPennParameters& p) {
  const int level = level_index(stem.level);
  return {.turn_deg =
              -p.split_angle[level] + draw_signed(stem.key, Draw::split_angle, at) * p.split_angle_v[level]};
}

/// split_angle ≥ 0: the parts lean away from the stem and are spread about z; the angle is paid back over the
/// remaining segments [Weber & Penn 95, §4.2].
Fork round_fork(const GrowingStem& stem, int at, int count, bool at_base, const WeberPennParameters& p) {
  const int level = level_index(stem.level);
  const float declination = declination_deg(stem.turtle.forward);
  const float jitter_deg = draw_signed(stem.key, Draw::split_angle, at) * p.split_angle_v[level];
  const float angle_deg = std::max(0.f, p.split_angle[level] + jitter_deg - declination);
  const float u = draw_unit(stem.key, Draw::split_spread, at);
  const float spread_deg = at_base ? 360.f * static_cast<float>(count) / static_cast<float>(count + 1)
                                   : -(20 + 0.75f * (30 + std::fabs(declination - 90) * u * u));
  return {.pitch_deg = angle_deg / 2,
          .spread_deg = spread_deg,
          .correction_deg = angle_deg / static_cast<float>(segment_count(p, stem.level) - at)};
}

/// Turns part `index` of count + 1, 0 being the stem itself.
void turn_into_fork(StemTurtle& turtle, const Fork& fork, int index, int count) {
  const float side = static_cast<float>(index) / static_cast<float>(count) - 0.5f;
  turtle.turn_right(fork.turn_deg * side);
  turtle.pitch_down(fork.pitch_deg);
  turtle.rotate_about({0, 0, 1}, fork.spread_deg * side);
}

GrowingStem make_clone(const GrowingStem& stem, int at, int index, const WeberPennParameters& p) {
  GrowingStem clone = stem;
  clone.child_index = kFirstSplit + kStemsPerSplit * static_cast<unsigned>(at) + static_cast<unsigned>(index);
  clone.key = child_key(stem.key, clone.child_index);
  clone.path_length = stem.path_length + 1;
  clone.cursor = stem.cursor.child(clone.child_index);
  clone.axis = clone.cursor.axis();
  if (clone.cursor.own_change()) find_parameters(clone);  // else those of its stem
  clone.first_segment = at;
  clone.child_share = stem.branch_factor * (1 - static_cast<float>(at) / segment_count(p, stem.level));
  clone.split_error = draw_unit(clone.key, Draw::split_error);
  return clone;
}

/// What overrides do to a stem that splits off; false where they remove it. It has followed those of the stem
/// up to there, so that only its own are new.
bool change_clone(GrowingStem& clone, const WeberPennParameters& p) {
  const BranchChange* change = clone.cursor.own_change();
  if (change == nullptr) return true;
  clone.key = reseeded(clone.key, change->seed);
  clone.turtle.roll_right((*change)[Quantity::rotation].apply(0));
  clone.turtle.pitch_down((*change)[Quantity::down_angle].apply(0));
  clone.length_m = (*change)[Quantity::length].apply(clone.length_m);
  clone.radius_m = (*change)[Quantity::radius].apply(clone.radius_m);
  const ExtraCurve extra = extra_curve(change, clone.level, p);
  clone.extra_curve.whole_deg += extra.whole_deg;
  clone.extra_curve.back_deg += extra.back_deg;
  return !change->removed && clone.length_m > 0;
}

/// Splits at segment end `at` into count + 1: `count` clones, and the stem itself, which is turned as well.
void split(GrowingStem& stem, int at, int count, bool at_base, const WeberPennParameters& p,
           StemVisitor& visitor) {
  const Fork fork = p.split_angle[level_index(stem.level)] < 0 ? flat_fork(stem, at, p)
                                                               : round_fork(stem, at, count, at_base, p);
  stem.split_correction_deg = fork.correction_deg;
  for (int index = 1; index <= count; ++index) {
    GrowingStem clone = make_clone(stem, at, index, p);
    turn_into_fork(clone.turtle, fork, index, count);
    if (!change_clone(clone, parameters_of(clone, p))) continue;
    clone.turtle.renormalize();
    visitor.split(clone);
  }
  turn_into_fork(stem.turtle, fork, 0, count);
}

/// How many clones leave the stem at segment end `at`, which is not its tip.
int split_count(GrowingStem& stem, int at, bool at_base, const WeberPennParameters& p) {
  return at_base ? base_split_count(stem, p) : diffused_split_count(stem, at, p);
}

/// Like walk_stem, for a stem that follows an axis: clones leave it where they would leave it without.
void walk_axis(GrowingStem stem, const WeberPennParameters& p, StemVisitor& visitor) {
  const int segments = segment_count(p, stem.level), parts = segment_count(stem, p) / segments;
  AxisWalk walk(stem, p);
  for (int index = stem.first_segment * parts; index < segments * parts; ++index) {
    const Segment segment = walk.next();
    stem.turtle = segment.end;
    const int at = (index + 1) / parts;
    const bool at_end = (index + 1) % parts == 0 && at < segments, at_base = is_base_split(stem, at, p);
    const int count = at_end ? split_count(stem, at, at_base, p) : 0;
    if (!visitor.segment(stem, segment)) return;
    if (count > 0) split(stem, at, count, at_base, p, visitor);
  }
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

ExtraCurve extra_curve(const BranchChange* change, int level, const WeberPennParameters& p) {
  if (change == nullptr) return {};
  const int i = level_index(level);
  const float whole_deg = p.curve[i] + p.curve_back[i],
              back_deg = p.curve_back[i] != 0 ? p.curve_back[i] : p.curve[i] / 2;
  return {(*change)[Quantity::curvature].apply(whole_deg) - whole_deg,
          (*change)[Quantity::curvature_back].apply(back_deg) - back_deg};
}

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
  if (stem.first_segment == 0) stem.split_error = first_split_error(stem);
  if (stem.axis) return walk_axis(stem, p, visitor);
  if (p.curve_v[level_index(stem.level)] < 0) return walk_helix(stem, p, visitor);
  const int segments = segment_count(p, stem.level);
  Vec3 heading = stem.turtle.forward;
  for (int index = stem.first_segment; index < segments; ++index) {
    const Segment segment = advance(stem, heading, index, segments);
    heading = stem.turtle.forward;
    const int at = index + 1;
    const bool at_tip = at == segments, at_base = is_base_split(stem, at, p);
    const int count = at_tip ? 0 : split_count(stem, at, at_base, p);
    if (!visitor.segment(stem, segment) || at_tip) return;
    if (count > 0)
      split(stem, at, count, at_base, p, visitor);
    else
      turn(stem, at, p);
    apply_tropism(stem, p);
    stem.turtle.renormalize();
  }
}

}  // namespace espalier
