// Placing leaves, see leaf_batch.h. Equations as in children.cpp and leaf_placement.cpp.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "weber_penn/leaf_batch.cpp"
#include <hwy/foreach_target.h>
// Highway's order: foreach_target before the files it compiles again.
#include <hwy/highway.h>

#include <algorithm>

#include "core/vector_math-inl.h"
#include "weber_penn/leaf_batch.h"
#include "weber_penn/leaf_placement.h"

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {
namespace {

/// A number that all lanes share: they are on one segment.
Vector3 set3(Vec3 v) { return {set(v.x), set(v.y), set(v.z)}; }

struct OnCurve {
  Vector3 point, tangent;
};

/// Points of the segment's curve, and tangents of any length but 0.
OnCurve on_curve(const Segment& segment, Vector t) {
  const Vector3 a = set3(segment.start_m), b = set3(segment.handle_out_m), c = set3(segment.handle_in_m),
                e = set3(segment.end_m);
  const Vector u = hn::Sub(set(1), t), uu = hn::Mul(u, u), tt = hn::Mul(t, t), ut = hn::Mul(u, t);
  const Vector3 derivative = (b - a) * uu + (c - b) * hn::Mul(set(2), ut) + (e - c) * tt;
  const auto has_direction = hn::Gt(dot(derivative, derivative), set(1e-24f));
  return {a * hn::Mul(uu, u) + b * hn::Mul(set(3), hn::Mul(uu, t)) + c * hn::Mul(set(3), hn::Mul(u, tt)) +
              e * hn::Mul(tt, t),
          choose(has_direction, derivative, set3(segment.end.forward))};
}

/// stem_radius_m for taper < 2 [stem_radius.cpp].
Vector radius_at(const GrowingStem& stem, Vector z, float taper) {
  const Vector base = set(stem.radius_m);
  const Vector cone = hn::Mul(base, hn::Sub(set(1), hn::Mul(set(taper < 1 ? taper : 2 - taper), z)));
  if (taper < 1) return cone;
  const Vector to_tip = hn::Mul(hn::Sub(set(1), z), set(stem.length_m));
  const Vector across = hn::Sub(to_tip, cone);
  const Vector squared = hn::Sub(hn::Mul(cone, cone), hn::Mul(across, across));
  return hn::IfThenElse(hn::Ge(to_tip, cone), cone, hn::Sqrt(hn::Max(squared, set(0))));
}

/// ChildPlacer::down_angle_deg; `level` is that of the leaves.
Vector down_angle_at(Vector z, Vector jitter, const WeberPennParameters& p, int level, float base_size) {
  const float angle = p.down_angle[level], variation = p.down_angle_v[level];
  if (variation >= 0) return hn::Add(set(angle), hn::Mul(jitter, set(variation)));
  const Vector ratio = hn::Mul(hn::Sub(set(1), z), set(1 / (1 - base_size)));
  const Vector shape = hn::Add(set(0.2f), hn::Mul(set(0.8f), ratio));  // conical
  const Vector shaped = hn::Add(set(angle), hn::Mul(set(variation), hn::Sub(set(1), hn::Mul(set(2), shape))));
  return hn::Mul(shaped, hn::Add(set(1), hn::Mul(set(0.1f), jitter)));
}

/// Along the segment, in [0, 1]; `k` counts leaves of the run.
Vector run_position(const ChildRun& run, Vector k, hn::Mask<Floats> is_odd) {
  const Vector even = hn::Add(set(run.t_start), hn::Mul(k, set(run.t_step)));
  const Vector t = hn::IfThenElse(is_odd, hn::Add(even, set(run.t_odd)), even);
  return hn::Min(hn::Max(t, set(0)), set(1));
}

/// Of the down angle, in [-1, 1).
Vector draw_jitter(const GrowingStem& stem, int first_child, int count, const WeberPennParameters& p) {
  if (p.down_angle_v[level_index(stem.level + 1)] == 0) return set(0);
  alignas(64) std::array<float, kMostLanes> drawn{};
  for (int i = 0; i < count; ++i)
    drawn[static_cast<std::size_t>(i)] = draw_signed(stem.key, Draw::child_down_angle, first_child + i);
  return hn::Load(Floats(), drawn.data());
}

using Columns3 = WaitingLeaves::Columns3;

void store(const Vector3& v, Columns3& columns, std::size_t at) {
  const Floats d;
  hn::StoreU(v.x, d, &columns.x[at]);
  hn::StoreU(v.y, d, &columns.y[at]);
  hn::StoreU(v.z, d, &columns.z[at]);
}

Vector3 load(const Columns3& columns, std::size_t at) {
  const Floats d;
  return {hn::Load(d, &columns.x[at]), hn::Load(d, &columns.y[at]), hn::Load(d, &columns.z[at])};
}

/// Puts the leaves of a run on their segment, grown to this share of leaf_scale. Writes whole vectors: up to
/// 7 rows more than there are leaves.
void add_run(const GrowingStem& stem, const Segment& segment, const ChildRun& run, float growth,
             const WeberPennParameters& p, WaitingLeaves& leaves) {
  const hn::RebindToSigned<Floats> di;
  const int lanes = static_cast<int>(hn::Lanes(di)), level = level_index(stem.level);
  const Vector3 across = set3(espalier::cross(segment.end.forward, segment.end.right));
  for (int first = 0; first < run.count; first += lanes) {
    const auto k = hn::Iota(di, first);
    const Vector along = hn::ConvertTo(Floats(), k);
    const auto is_odd = hn::MaskFromVec(hn::BitCast(Floats(), hn::Neg(hn::And(k, hn::Set(di, 1)))));
    const Vector t = run_position(run, along, is_odd);
    const Vector z = hn::Add(set(segment.z_start), hn::Mul(t, set(segment.z_end - segment.z_start)));
    const Vector jitter = draw_jitter(stem, run.first + first, std::min(lanes, run.count - first), p);
    const OnCurve curve = on_curve(segment, t);
    const auto at = static_cast<std::size_t>(leaves.count + first);
    store(curve.point, leaves.point, at);
    store(curve.tangent, leaves.tangent, at);
    store(across, leaves.across, at);
    hn::StoreU(radius_at(stem, z, p.taper[level]), Floats(), &leaves.stem_radius_m[at]);
    hn::StoreU(hn::LoadU(Floats(), run.roll_deg + first), Floats(), &leaves.roll_deg[at]);
    hn::StoreU(down_angle_at(z, jitter, p, level_index(stem.level + 1), p.base_size[level]), Floats(),
               &leaves.down_deg[at]);
    hn::StoreU(set(growth), Floats(), &leaves.growth[at]);
    std::fill_n(&leaves.kind[at], kMostLanes, LeafKind::leaf);
  }
}

/// ChildPlacer::frame_at: unit tangents, and `right` before the roll.
void make_frames(WaitingLeaves& leaves, std::size_t at) {
  const Vector3 along = load(leaves.tangent, at);
  const Vector3 tangent = along * hn::Div(set(1), hn::Sqrt(dot(along, along)));
  const Vector3 right = cross(load(leaves.across, at), tangent);
  const Vector norm = hn::Sqrt(dot(right, right));
  const auto has_direction = hn::Gt(norm, set(1e-12f));
  Vector3 unit = right * hn::Div(set(1), norm);
  if (!hn::AllTrue(Floats(), has_direction))
    unit = choose(has_direction, unit,
                  normalized(cross(tangent, {set(0), set(1), set(0)}), {set(1), set(0), set(0)}));
  store(tangent, leaves.tangent, at);
  store(unit, leaves.right, at);
}

void store(const Vector3& v, Vec3* to) { hn::StoreInterleaved3(v.x, v.y, v.z, Floats(), &to->x); }

/// Where leaves go in the plant.
struct LeafRows {
  Vec3 *position_m, *axis, *side;
};

/// Rolls the frames, and turns the leaves down from them.
void turn_leaves(const WaitingLeaves& leaves, std::size_t at, const LeafRows& to) {
  const Floats d;
  const Vector3 tangent = load(leaves.tangent, at), flat = load(leaves.right, at);
  const SineCosine roll = sine_cosine_deg(hn::Load(d, &leaves.roll_deg[at])),
                   down = sine_cosine_deg(hn::Load(d, &leaves.down_deg[at]));
  const Vector3 right = flat * roll.cosine + cross(tangent, flat) * roll.sine;
  const Vector3 outward = cross(tangent, right);
  store(load(leaves.point, at) + outward * hn::Load(d, &leaves.stem_radius_m[at]), to.position_m + at);
  store(tangent * down.cosine + outward * down.sine, to.axis + at);
  store(right, to.side + at);
}

Vector3 turned_about_z(const Vector3& v, const SineCosine& turn) {
  return {hn::Sub(hn::Mul(v.x, turn.cosine), hn::Mul(v.y, turn.sine)),
          hn::Add(hn::Mul(v.x, turn.sine), hn::Mul(v.y, turn.cosine)), v.z};
}

Vector3 load(const Vec3* from) {
  Vector3 v;
  hn::LoadInterleaved3(Floats(), &from->x, v.x, v.y, v.z);
  return v;
}

/// Turns leaves about z by a share of the angle between their normal and the way out [leaf_placement.cpp].
void bend_outwards(const LeafRows& leaves, std::size_t at, float leaf_bend) {
  const Vector3 position = load(leaves.position_m + at), axis = load(leaves.axis + at),
                side = load(leaves.side + at);
  const Vector3 normal = cross(side, axis);
  const Vector sine = hn::Sub(hn::Mul(normal.x, position.y), hn::Mul(normal.y, position.x));
  const Vector cosine = hn::Add(hn::Mul(normal.x, position.x), hn::Mul(normal.y, position.y));
  const SineCosine turn = sine_cosine_deg(hn::Mul(set(leaf_bend), arc_tangent2_deg(sine, cosine)));
  store(turned_about_z(axis, turn), leaves.axis + at);
  store(turned_about_z(side, turn), leaves.side + at);
}

/// Writes whole vectors: up to 7 rows more than there are leaves.
void place_all(const WeberPennParameters& p, WaitingLeaves& leaves, Vec3* position_m, Vec3* axis,
               Vec3* side) {
  const LeafRows to{position_m, axis, side};
  const auto count = static_cast<std::size_t>(leaves.count), lanes = hn::Lanes(Floats());
  for (std::size_t at = 0; at < count; at += lanes) make_frames(leaves, at);
  for (std::size_t at = 0; at < count; at += lanes) turn_leaves(leaves, at, to);
  if (p.leaf_bend > 0)
    for (std::size_t at = 0; at < count; at += lanes) bend_outwards(to, at, p.leaf_bend);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace espalier {

HWY_EXPORT(add_run);
HWY_EXPORT(place_all);

namespace {

/// Without its first `skipped` leaves.
ChildRun rest_of(const ChildRun& run, int skipped) {
  ChildRun rest = run;
  rest.first += skipped;
  rest.count -= skipped;
  const bool is_odd = skipped % 2 == 1;
  rest.t_start += static_cast<float>(skipped) * run.t_step + (is_odd ? run.t_odd : 0);
  if (is_odd) rest.t_odd = -run.t_odd;
  rest.roll_deg += skipped;
  return rest;
}

}  // namespace

bool LeafBatch::takes(const GrowingStem& stem, const WeberPennParameters& p) {
  const int level = level_index(stem.level);
  return stem.level > 0 && p.leaf_blos_num > 0 && p.curve_v[level] >= 0 && p.taper[level] < 2;
}

void LeafBatch::add(const GrowingStem& stem, const Segment& segment, ChildPlacer& placer) {
  const float bare = p_.base_size[level_index(stem.level)], z_length = segment.z_end - segment.z_start;
  const auto is_bare = [&](float t) { return segment.z_start + std::clamp(t, 0.f, 1.f) * z_length < bare; };
  for (ChildRun run; placer.next_run(run);) {
    while (run.count > 0 && is_bare(run.t_start)) run = rest_of(run, 1);
    add_run(stem, segment, run, 1);
  }
  for (ChildSlot slot; placer.next_slot(slot);) {
    if (!(slot.grown_fraction > 0) || is_bare(slot.t)) continue;
    const std::array<float, 8> roll_deg{slot.roll_deg};
    add_run(stem, segment, {.first = slot.index, .count = 1, .t_start = slot.t, .roll_deg = roll_deg.data()},
            slot.grown_fraction);
  }
}

void LeafBatch::add_run(const GrowingStem& stem, const Segment& segment, const ChildRun& run,
                        float grown_fraction) {
  const int room = WaitingLeaves::kMost - waiting_.count;
  if (run.count > room) {
    ChildRun part = run;
    part.count = room;
    add_run(stem, segment, part, grown_fraction);
    flush();
    return add_run(stem, segment, rest_of(run, room), grown_fraction);
  }
  HWY_DYNAMIC_DISPATCH(add_run)(stem, segment, run, leaf_growth(stem, grown_fraction, p_), p_, waiting_);
  if (p_.blossom_rate > 0)
    for (int i = 0; i < run.count; ++i)
      waiting_.kind[static_cast<std::size_t>(waiting_.count + i)] = leaf_kind(stem, run.first + i, p_);
  waiting_.count += run.count;
}

void LeafBatch::append_sizes() {
  const std::size_t before = leaves_.size(), count = static_cast<std::size_t>(waiting_.count);
  leaves_.kind.insert(leaves_.kind.end(), waiting_.kind.begin(), waiting_.kind.begin() + waiting_.count);
  leaves_.length_m.resize(before + count);
  leaves_.width_m.resize(before + count);
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_leaf = waiting_.kind[i] == LeafKind::leaf;
    leaves_.length_m[before + i] = (is_leaf ? p_.leaf_scale : p_.blossom_scale) * waiting_.growth[i];
    leaves_.width_m[before + i] = leaves_.length_m[before + i] * (is_leaf ? p_.leaf_scale_x : 1);
  }
}

void LeafBatch::flush() {
  const std::size_t before = leaves_.position_m.size(),
                    after = before + static_cast<std::size_t>(waiting_.count);
  for (std::vector<Vec3>* column : {&leaves_.position_m, &leaves_.axis, &leaves_.side})
    column->resize(after + 8);
  HWY_DYNAMIC_DISPATCH(place_all)
  (p_, waiting_, &leaves_.position_m[before], &leaves_.axis[before], &leaves_.side[before]);
  for (std::vector<Vec3>* column : {&leaves_.position_m, &leaves_.axis, &leaves_.side}) column->resize(after);
  append_sizes();
  waiting_.count = 0;
}

}  // namespace espalier
#endif
