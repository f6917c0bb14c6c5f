// The walk of stem_walk.cpp in vectors: every line is that of the plain walk, in the same order of roundings.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "weber_penn/stem_batch.cpp"
#include "weber_penn/stem_batch.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/vector_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {
namespace {

constexpr std::size_t kStems = StemBatch::kMostStems;

/// One number for each stem of the batch.
struct alignas(64) Numbers : std::array<float, kStems> {};

struct Numbers3 {
  Numbers x, y, z;

  void set(std::size_t i, Vec3 v) { x[i] = v.x, y[i] = v.y, z[i] = v.z; }
  Vec3 get(std::size_t i) const { return {x[i], y[i], z[i]}; }
  Vector3 load(std::size_t first) const {
    const Floats d;
    return {hn::Load(d, &x[first]), hn::Load(d, &y[first]), hn::Load(d, &z[first])};
  }
  void store(std::size_t first, const Vector3& v) {
    const Floats d;
    hn::Store(v.x, d, &x[first]);
    hn::Store(v.y, d, &y[first]);
    hn::Store(v.z, d, &z[first]);
  }
};

struct Frames {
  Numbers3 position, forward, right;
  Numbers segment_m;
};

/// The turtle of each lane [turtle.h].
struct TurtleLanes {
  Vector3 forward, right;

  void turn_left(Vector angle_deg) {
    const auto [sine, cosine] = sine_cosine_deg(hn::Neg(angle_deg));
    const Vector3 ahead = forward;
    forward = ahead * cosine + right * sine;
    right = right * cosine - ahead * sine;
  }
  void pitch_down(Vector angle_deg) {
    const auto [sine, cosine] = sine_cosine_deg(angle_deg);
    forward = forward * cosine + cross(forward, right) * sine;
  }
  static Vector3 rotated(const Vector3& v, const Vector3& axis, const SineCosine& turn) {
    return v * turn.cosine + cross(axis, v) * turn.sine +
           axis * hn::Mul(dot(axis, v), hn::Sub(set(1), turn.cosine));
  }
  /// apply_tropism [stem_walk.cpp].
  void pull(Vec3 tropism) {
    const Vector3 axis = cross(forward, {set(tropism.x), set(tropism.y), set(tropism.z)});
    const Vector strength = hn::Sqrt(dot(axis, axis));
    const auto is_pulled = hn::Gt(strength, set(1e-9f));
    const Vector3 unit = axis * hn::Div(set(1), strength);
    const SineCosine turn = sine_cosine_deg(hn::Mul(set(10), strength));
    forward = choose(is_pulled, rotated(forward, unit, turn), forward);
    right = choose(is_pulled, rotated(right, unit, turn), right);
  }
  void renormalize() {
    forward = normalized(forward, {set(0), set(0), set(1)});
    right = normalized(right - forward * dot(forward, right), any_perpendicular(forward));
  }
  static Vector3 any_perpendicular(const Vector3& a) {
    const auto is_flat = hn::Lt(hn::Abs(a.z), set(0.9f));
    const Vector3 other = choose(is_flat, {set(0), set(0), set(1)}, {set(1), set(0), set(0)});
    return normalized(cross(a, other), {set(0), set(0), set(1)});
  }
};

/// Draws of the stems for one purpose at one segment end, times `most` / segments; zeros where nothing
/// varies.
Vector jitter(std::span<const GrowingStem> stems, Draw purpose, int at, float most, int segments,
              std::size_t first) {
  if (most == 0) return set(0);
  Numbers drawn{};
  for (std::size_t i = 0; i < stems.size(); ++i)
    drawn[i] = draw_signed(stems[i].key, purpose, at) * most / segments;
  return hn::Load(Floats(), &drawn[first]);
}

/// The part of curve_angle_deg that all stems of the level share [stem_walk.cpp].
float shared_curve_deg(int level, int at, int segments, const WeberPennParameters& p) {
  if (p.curve_back[level] == 0) return p.curve[level] / segments;
  return (2 * at <= segments ? p.curve[level] : p.curve_back[level]) * 2 / segments;
}

/// Turns the frames at segment end `at`.
void turn(std::span<const GrowingStem> stems, int at, int segments, const WeberPennParameters& p,
          Frames& frames) {
  const int level = level_index(stems[0].level);
  const Vec3 tropism{p.tropism_x, p.tropism_y, stems[0].level >= 2 ? p.tropism_z : 0};
  for (std::size_t first = 0; first < stems.size(); first += hn::Lanes(Floats())) {
    TurtleLanes turtle{frames.forward.load(first), frames.right.load(first)};
    if (p.bend_v[level] != 0)
      turtle.turn_left(jitter(stems, Draw::bend, at, p.bend_v[level], segments, first));
    turtle.pitch_down(hn::Add(set(shared_curve_deg(level, at, segments, p)),
                              jitter(stems, Draw::curve, at, p.curve_v[level], segments, first)));
    if (!(tropism == Vec3{})) turtle.pull(tropism);
    turtle.renormalize();
    frames.forward.store(first, turtle.forward);
    frames.right.store(first, turtle.right);
  }
}

/// The segment that each stem grows next; its frame moves to the end.
void advance(std::size_t count, int index, int segments, const Numbers3& heading, Frames& frames,
             Segment* out) {
  for (std::size_t i = 0; i < count; ++i, out += segments) {
    const float third_m = frames.segment_m[i] / 3;
    out->start_m = frames.position.get(i);
    out->handle_out_m = out->start_m + heading.get(i) * third_m;
    out->end.forward = frames.forward.get(i);
    out->end.right = frames.right.get(i);
    out->end_m = out->end.position_m = out->start_m + out->end.forward * frames.segment_m[i];
    out->handle_in_m = out->end_m - out->end.forward * third_m;
    out->z_start = static_cast<float>(index) / static_cast<float>(segments);
    out->z_end = static_cast<float>(index + 1) / static_cast<float>(segments);
    frames.position.set(i, out->end_m);
  }
}

/// out: segments of the first stem, then of the second, and so on.
void walk_batch(std::span<const GrowingStem> stems, int segments, const WeberPennParameters& p,
                Segment* out) {
  Frames frames{};
  for (std::size_t i = 0; i < stems.size(); ++i) {
    frames.position.set(i, stems[i].turtle.position_m);
    frames.forward.set(i, stems[i].turtle.forward);
    frames.right.set(i, stems[i].turtle.right);
    frames.segment_m[i] = stems[i].length_m / static_cast<float>(segments);
  }
  Numbers3 heading = frames.forward;
  for (int index = 0; index < segments; ++index) {
    advance(stems.size(), index, segments, heading, frames, out + index);
    heading = frames.forward;
    if (index + 1 < segments) turn(stems, index + 1, segments, p, frames);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace espalier {

HWY_EXPORT(walk_batch);

bool StemBatch::takes(int level, const WeberPennParameters& p) {
  const int i = level_index(level);
  return p.curve_v[i] >= 0 && p.seg_splits[i] <= 0 && !(level == 0 && p.base_splits != 0);
}

void StemBatch::walk(std::span<const GrowingStem> stems, const WeberPennParameters& p) {
  const int segments = segment_count(p, stems[0].level);
  per_stem_ = static_cast<std::size_t>(segments);
  segments_.resize(per_stem_ * kMostStems);
  HWY_DYNAMIC_DISPATCH(walk_batch)(stems, segments, p, segments_.data());
}

}  // namespace espalier
#endif
