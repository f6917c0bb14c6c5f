// Putting children on curves, see child_batch.h. Equations as in children.cpp.
#undef HWY_TARGET_INCLUDE
// NOLINTNEXTLINE(bugprone-macro-parentheses): a name of a file
#define HWY_TARGET_INCLUDE <espalier/weber_penn/simd/child_batch.cpp>
#include <hwy/foreach_target.h>
// Highway's order: foreach_target before the files it compiles again.
#include <hwy/highway.h>

#include <algorithm>

#include <espalier/core/random_lanes-inl.h>
#include <espalier/weber_penn/scalar/stem_radius-inl.h>
#include <espalier/weber_penn/simd/child_batch.h>
#include <espalier/weber_penn/simd/waiting_children-inl.h>

#ifndef ESPALIER_WEBER_PENN_SPREAD_RUN
#define ESPALIER_WEBER_PENN_SPREAD_RUN
namespace espalier {
/// The growth of children: of all of them, times a curve along the parent above its bare base.
struct ChildGrowth {
  float share;
  const AlongCurve& along;
};

/// Children [first, first + count) of a stem.
struct SpreadRun {
  const StemCurve& curve;
  const ChildSpread& spread;
  ChildRolls rolls;
  int first, count;
};
}  // namespace espalier
#endif

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {
namespace {

using Integers = hn::RebindToSigned<Floats>;
using IntegerLanes = hn::Vec<Integers>;

struct OnCurve {
  Vector3 point, tangent, across;  ///< tangents are of any length but 0
};

/// Puts children in rows from `at` on. Writes whole vectors: up to 7 rows more than there are children.
class Rows {
 public:
  Rows(const GrowingStem& stem, const WeberPennParameters& p, WaitingChildren& children)
      : stem_(stem),
        p_(p),
        children_(children),
        level_(level_index(stem.level)),
        child_level_(level_index(stem.level + 1)),
        per_crown_(1 / (1 - p.base_size[level_])) {}

  /// Children `index` … at z along the stem.
  HWY_INLINE void put(const OnCurve& curve, Vector z, Vector roll_deg, const ChildGrowth& growth, int index,
                      std::size_t at) {
    const Floats d;
    store(curve.point, children_.point, at);
    store(curve.tangent, children_.tangent, at);
    store(curve.across, children_.across, at);
    hn::StoreU(radius_at(stem_, z, p_), d, &children_.parent_radius_m[at]);
    hn::StoreU(roll_deg, d, &children_.roll_deg[at]);
    const AlongCurve& down_along = p_.curves.down_angle_along[child_level_];
    const Vector drawn_deg = down_deg(z, index);
    hn::StoreU(down_along.is_neutral ? drawn_deg : hn::Add(drawn_deg, curve_at(down_along, above_base(z))), d,
               &children_.down_deg[at]);
    hn::StoreU(hn::Mul(z, set(stem_.length_m)), d, &children_.offset_m[at]);
    const Vector share = set(growth.share);
    hn::StoreU(growth.along.is_neutral ? share : hn::Mul(share, curve_at(growth.along, above_base(z))), d,
               &children_.growth[at]);
    hn::StoreU(counted_from(index), Integers(), &children_.index[at]);
  }

 private:
  /// place_above_base.
  HWY_INLINE Vector above_base(Vector z) const {
    return hn::Mul(hn::Sub(z, set(p_.base_size[level_])), set(per_crown_));
  }

  /// ChildPlacer::drawn_down_angle_deg.
  HWY_INLINE Vector down_deg(Vector z, int index) const {
    const float angle = p_.down_angle[child_level_], variation = p_.down_angle_v[child_level_];
    if (variation == 0) return set(angle);
    const Vector jitter = signed_draws(stem_.key, static_cast<std::uint32_t>(Draw::child_down_angle),
                                       static_cast<std::uint32_t>(index));
    if (variation > 0) return hn::Add(set(angle), hn::Mul(jitter, set(variation)));
    const Vector ratio = hn::Mul(hn::Sub(set(1), z), set(1 / (1 - p_.base_size[level_])));
    const Vector shape = hn::Add(set(0.2f), hn::Mul(set(0.8f), ratio));  // conical
    const Vector shaped =
        hn::Add(set(angle), hn::Mul(set(variation), hn::Sub(set(1), hn::Mul(set(2), shape))));
    return hn::Mul(shaped, hn::Add(set(1), hn::Mul(set(0.1f), jitter)));
  }

  const GrowingStem& stem_;
  const WeberPennParameters& p_;
  WaitingChildren& children_;
  int level_, child_level_;
  float per_crown_;
};

hn::Mask<Floats> is_odd(IntegerLanes k) {
  return hn::MaskFromVec(hn::BitCast(Floats(), hn::Neg(hn::And(k, hn::Set(Integers(), 1)))));
}

Vector in_unit(Vector t) { return hn::Min(hn::Max(t, set(0)), set(1)); }

/// A number that all lanes share: they are on one segment.
Vector3 set3(Vec3 v) { return {set(v.x), set(v.y), set(v.z)}; }

/// Points of the segment's curve, and tangents.
HWY_INLINE OnCurve on_segment(const Segment& segment, Vector t) {
  const Vector3 a = set3(segment.start_m), b = set3(segment.handle_out_m), c = set3(segment.handle_in_m),
                e = set3(segment.end_m);
  const Vector u = hn::Sub(set(1), t), uu = hn::Mul(u, u), tt = hn::Mul(t, t), ut = hn::Mul(u, t);
  const Vector3 derivative = (b - a) * uu + (c - b) * hn::Mul(set(2), ut) + (e - c) * tt;
  const auto has_direction = hn::Gt(dot(derivative, derivative), set(1e-24f));
  return {a * hn::Mul(uu, u) + b * hn::Mul(set(3), hn::Mul(uu, t)) + c * hn::Mul(set(3), hn::Mul(u, tt)) +
              e * hn::Mul(tt, t),
          choose(has_direction, derivative, set3(segment.end.forward)),
          set3(espalier::cross(segment.end.forward, segment.end.right))};
}

/// The children of a run, which share a segment.
void put_run(const GrowingStem& stem, const Segment& segment, const ChildRun& run, const ChildGrowth& growth,
             const WeberPennParameters& p, WaitingChildren& children) {
  const Integers di;
  const auto first_row = static_cast<std::size_t>(children.count);
  Rows rows(stem, p, children);
  for (int first = 0; first < run.count; first += static_cast<int>(hn::Lanes(di))) {
    const IntegerLanes k = counted_from(first);
    const Vector even = hn::Add(set(run.t_start), hn::Mul(hn::ConvertTo(Floats(), k), set(run.t_step)));
    const Vector t = run.t ? hn::LoadU(Floats(), run.t + first)
                           : in_unit(hn::IfThenElse(is_odd(k), hn::Add(even, set(run.t_odd)), even));
    const Vector z = hn::Add(set(segment.z_start), hn::Mul(t, set(segment.z_end - segment.z_start)));
    rows.put(on_segment(segment, t), z, hn::LoadU(Floats(), run.roll_deg + first), growth, run.first + first,
             first_row + static_cast<std::size_t>(first));
  }
}

/// Looks up the segments that a vector of places is on. Where all segments fit in a vector of eight, that is
/// a permutation.
class SegmentLookup {
 public:
  SegmentLookup(Vector segment, int segments)
      : index_(hn::ConvertTo(Integers(), segment)),
        in_a_vector_(static_cast<std::size_t>(segments) <= kLanes) {}

  Vector operator()(const float* table) const {
    if constexpr (kLanes == 8)
      if (in_a_vector_)
        return hn::TableLookupLanes(hn::LoadU(Floats(), table), hn::IndicesFromVec(Floats(), index_));
    return hn::GatherIndex(Floats(), table, index_);
  }
  Vector3 operator()(const StemCurve::Rows3& rows) const {
    return {(*this)(rows.x), (*this)(rows.y), (*this)(rows.z)};
  }

 private:
  static constexpr std::size_t kLanes = hn::MaxLanes(Floats());
  IntegerLanes index_;
  bool in_a_vector_;
};

/// The cubic curve through handles at a third of the segment's length along h and f, its headings at start
/// and end: its point is start + length·(h·t(1−t)² + f·t²(2−t)), its tangent h·(1−t)(1−3t) + f·t(4−3t).
HWY_INLINE OnCurve on_curve(const StemCurve& curve, const SegmentLookup& lookup, Vector t) {
  const Vector u = hn::Sub(set(1), t), ut = hn::Mul(u, t), three_t = hn::Mul(set(3), t);
  const Vector length_m = set(curve.segment_m);
  const Vector along_h = hn::Mul(length_m, hn::Mul(ut, u)),
               along_f = hn::Mul(length_m, hn::Mul(hn::Mul(t, t), hn::Sub(set(2), t)));
  const Vector3 h = lookup(curve.heading_at_start()), f = lookup(curve.heading());
  const Vector3 tangent = h * hn::Mul(u, hn::Sub(set(1), three_t)) + f * hn::Mul(t, hn::Sub(set(4), three_t));
  const auto has_direction = hn::Gt(dot(tangent, tangent), set(1e-12f));
  return {lookup(curve.point()) + h * along_h + f * along_f, choose(has_direction, tangent, f),
          cross(f, lookup(curve.right()))};
}

/// Children of a whole stem.
void put_spread(const GrowingStem& stem, const SpreadRun& run, const ChildGrowth& growth,
                const WeberPennParameters& p, WaitingChildren& children) {
  const Integers di;
  const ChildSpread& spread = run.spread;
  const int segments = run.curve.segments;
  const auto first_row = static_cast<std::size_t>(children.count);
  const Vector z_per_segment = set(static_cast<float>(segments));
  Rows rows(stem, p, children);
  for (int first = 0; first < run.count; first += static_cast<int>(hn::Lanes(di))) {
    const int child = run.first + first;
    const IntegerLanes k = counted_from(child);
    const Vector number = hn::ConvertTo(Floats(), k);
    Vector segment = hn::Zero(Floats());
    for (int i = 0; i + 1 < segments; ++i)
      segment = hn::Add(segment, hn::IfThenElseZero(hn::Ge(number, set(spread.whole()[i])), set(1)));
    const SegmentLookup lookup(segment, segments);
    const Vector shift = hn::IfThenElseZero(is_odd(k), set(spread.odd_shift()));
    const Vector t = spread.places()
                         ? hn::LoadU(Floats(), spread.places() + child)
                         : in_unit(hn::Mul(hn::Sub(hn::Sub(number, shift), lookup(spread.reached_before())),
                                           set(spread.inverse_rate())));
    const Vector z_start = hn::Div(segment, z_per_segment),
                 z_end = hn::Div(hn::Add(segment, set(1)), z_per_segment);
    const Vector z = hn::Add(z_start, hn::Mul(t, hn::Sub(z_end, z_start)));
    const Vector roll_deg =
        hn::Add(set(run.rolls.start_deg), hn::LoadU(Floats(), run.rolls.by_child_deg + child));
    rows.put(on_curve(run.curve, lookup, t), z, roll_deg, growth, child,
             first_row + static_cast<std::size_t>(first));
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace espalier {

HWY_EXPORT(put_run);
HWY_EXPORT(put_spread);

namespace {

/// The run without its first `skipped` children.
ChildRun rest_of(const ChildRun& run, int skipped) {
  ChildRun rest = run;
  rest.first += skipped;
  rest.count -= skipped;
  const bool is_odd = skipped % 2 == 1;
  rest.t_start += static_cast<float>(skipped) * run.t_step + (is_odd ? run.t_odd : 0);
  if (is_odd) rest.t_odd = -run.t_odd;
  rest.roll_deg += skipped;
  if (rest.t) rest.t += skipped;
  return rest;
}

}  // namespace

bool ChildBatch::takes_children_of(int level, const WeberPennParameters& p) {
  return level > 0 && p.curve_v[level_index(level)] >= 0 && p.taper[level_index(level)] < 2;
}

void ChildBatch::add(const GrowingStem& stem, const Segment& segment, ChildPlacer& placer) {
  const float bare = p_.base_size[level_index(stem.level)], z_length = segment.z_end - segment.z_start;
  const auto is_bare = [&](float t) { return segment.z_start + std::clamp(t, 0.f, 1.f) * z_length < bare; };
  for (ChildRun run; placer.next_run(run);) {
    while (run.count > 0 && is_bare(run.t ? *run.t : run.t_start)) run = rest_of(run, 1);
    add_run(stem, segment, run, 1);
  }
  for (ChildSlot slot; placer.next_slot(slot);) {
    if (!(slot.grown_fraction > 0) || is_bare(slot.t)) continue;
    const std::array<float, 8> roll_deg{slot.roll_deg};
    add_run(stem, segment, {.first = slot.index, .count = 1, .t_start = slot.t, .roll_deg = roll_deg.data()},
            slot.grown_fraction);
  }
}

const AlongCurve& ChildBatch::growth_along(int parent_level) const {
  return bears_ == ChildPlacer::Bears::leaves ? p_.curves.leaf_scale_along
                                              : p_.curves.length_along[level_index(parent_level + 1)];
}

void ChildBatch::add_run(const GrowingStem& stem, const Segment& segment, const ChildRun& run,
                         float grown_fraction) {
  const int room = WaitingChildren::kMost - waiting_.count;
  if (run.count > room) {
    ChildRun part = run;
    part.count = room;
    add_run(stem, segment, part, grown_fraction);
    flush();
    return add_run(stem, segment, rest_of(run, room), grown_fraction);
  }
  HWY_DYNAMIC_DISPATCH(put_run)
  (stem, segment, run, {growth(stem, grown_fraction), growth_along(stem.level)}, p_, waiting_);
  note(stem, waiting_.count, run.count);
  waiting_.count += run.count;
}

void ChildBatch::add(const GrowingStem& stem, const StemBatch& batch, std::size_t index_in_batch) {
  const bool bears_leaves = bears_ == ChildPlacer::Bears::leaves;
  const float count = bears_leaves ? leaf_count(stem, p_) : child_stem_count(stem, p_);
  if (ChildSpread::supports(count, stem.level + 1, p_))
    return add_spread(stem, batch.curve(index_in_batch), count);
  ChildPlacer placer(stem, bears_, p_);
  for (int i = 0; i < batch.segment_count(); ++i) {
    const Segment segment = batch.segment(index_in_batch, i);
    placer.begin(stem, segment);
    add(stem, segment, placer);
  }
}

void ChildBatch::add_spread(const GrowingStem& stem, const StemCurve& curve, float count) {
  const ChildSpread& spread = memory_.spread;
  const bool bears_leaves = bears_ == ChildPlacer::Bears::leaves;
  memory_.spread.spread(stem, count,
                        bears_leaves ? leaf_spacing(stem.level, p_) : stem_spacing(stem.level, p_), p_);
  const ChildRolls rolls = memory_.rolls.rolls(stem, spread.end(), p_);
  for (int first = spread.first(); first < spread.end();) {
    if (waiting_.count == WaitingChildren::kMost) flush();
    const int some = std::min(spread.end() - first, WaitingChildren::kMost - waiting_.count);
    HWY_DYNAMIC_DISPATCH(put_spread)
    (stem, {curve, spread, rolls, first, some}, {growth(stem, 1), growth_along(stem.level)}, p_, waiting_);
    note(stem, waiting_.count, some);
    waiting_.count += some;
    first += some;
  }
  if (spread.last_growth() == 1 || spread.first() >= spread.end()) return;
  float& last = waiting_.growth[static_cast<std::size_t>(waiting_.count - 1)];
  last =
      growth_along(stem.level).is_neutral ? growth(stem, spread.last_growth()) : last * spread.last_growth();
}

}  // namespace espalier
#endif
