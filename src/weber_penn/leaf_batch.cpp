// Placing noted leaves, see leaf_batch.h. Equations as in children.cpp and leaf_placement.cpp.
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

using Indices = hn::RebindToSigned<Floats>;

/// Gathers one member of each lane's row.
class RowLanes {
 public:
  RowLanes(const LeafNotes& notes, int first)
      : rows_(&notes.row[0].start_m.x),
        index_(hn::Mul(hn::LoadU(Indices(), &notes.row_index[static_cast<std::size_t>(first)]),
                       hn::Set(Indices(), kStride))) {}

  Vector number(float LeafRow::*member) const {
    static const LeafRow kRow{};
    return at(static_cast<int>(&(kRow.*member) - &kRow.start_m.x));
  }
  Vector3 vector(Vec3 LeafRow::*member) const {
    static const LeafRow kRow{};
    const int column = static_cast<int>(&(kRow.*member).x - &kRow.start_m.x);
    return {at(column), at(column + 1), at(column + 2)};
  }

 private:
  static constexpr int kStride = sizeof(LeafRow) / sizeof(float);
  Vector at(int column) const { return hn::GatherIndex(Floats(), rows_ + column, index_); }

  const float* rows_;
  hn::Vec<Indices> index_;
};

struct Heading {
  Vector3 point, forward;
};

/// Point and tangent of the segments' curves at t.
Heading on_curve(const RowLanes& segment, Vector t) {
  const Vector3 a = segment.vector(&LeafRow::start_m), b = segment.vector(&LeafRow::handle_out_m),
                c = segment.vector(&LeafRow::handle_in_m), e = segment.vector(&LeafRow::end_m);
  const Vector u = hn::Sub(set(1), t), uu = hn::Mul(u, u), tt = hn::Mul(t, t), ut = hn::Mul(u, t);
  const Vector3 derivative = (b - a) * uu + (c - b) * hn::Mul(set(2), ut) + (e - c) * tt;
  return {a * hn::Mul(uu, u) + b * hn::Mul(set(3), hn::Mul(uu, t)) + c * hn::Mul(set(3), hn::Mul(u, tt)) +
              e * hn::Mul(tt, t),
          normalized(derivative, segment.vector(&LeafRow::heading))};
}

/// stem_radius_m for taper < 2 [stem_radius.cpp].
Vector radius_at(const RowLanes& segment, Vector z, float taper) {
  const Vector base = segment.number(&LeafRow::base_radius_m);
  const Vector cone = hn::Mul(base, hn::Sub(set(1), hn::Mul(set(taper < 1 ? taper : 2 - taper), z)));
  if (taper < 1) return cone;
  const Vector to_tip = hn::Mul(hn::Sub(set(1), z), segment.number(&LeafRow::stem_length_m));
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

struct Placed {
  Vector3 position, axis, side;
};

Vector3 turned_about_z(const Vector3& v, const SineCosine& turn) {
  return {hn::Sub(hn::Mul(v.x, turn.cosine), hn::Mul(v.y, turn.sine)),
          hn::Add(hn::Mul(v.x, turn.sine), hn::Mul(v.y, turn.cosine)), v.z};
}

/// Turns leaves about z by a share of the angle between their normal and the way out [leaf_placement.cpp].
void bend_outwards(Placed& leaf, float leaf_bend) {
  const Vector3 normal = cross(leaf.side, leaf.axis);
  const Vector sine = hn::Sub(hn::Mul(normal.x, leaf.position.y), hn::Mul(normal.y, leaf.position.x));
  const Vector cosine = hn::Add(hn::Mul(normal.x, leaf.position.x), hn::Mul(normal.y, leaf.position.y));
  const SineCosine turn = sine_cosine_deg(hn::Mul(set(leaf_bend), arc_tangent2_deg(sine, cosine)));
  leaf.axis = turned_about_z(leaf.axis, turn);
  leaf.side = turned_about_z(leaf.side, turn);
}

/// Along the segment, in [0, 1]; `k` counts leaves of the run.
Vector run_position(const RowLanes& run, Vector k, hn::Mask<Floats> is_odd) {
  const Vector even = hn::Add(run.number(&LeafRow::t_start), hn::Mul(k, run.number(&LeafRow::t_step)));
  const Vector t = hn::IfThenElse(is_odd, hn::Add(even, run.number(&LeafRow::t_odd)), even);
  return hn::Min(hn::Max(t, set(0)), set(1));
}

Vector run_roll_deg(const RowLanes& run, Vector k, hn::Mask<Floats> is_odd, bool alternate) {
  const Vector roll =
      hn::Add(run.number(&LeafRow::roll_deg), hn::Mul(k, run.number(&LeafRow::roll_step_deg)));
  return alternate ? hn::IfThenElse(is_odd, hn::Neg(roll), roll) : roll;
}

Placed place(const LeafNotes& notes, int first, const WeberPennParameters& p, int stem_level) {
  const Floats d;
  const auto column = [&](const auto& values) {
    return hn::LoadU(d, &values[static_cast<std::size_t>(first)]);
  };
  const RowLanes segment(notes, first);
  const auto k = hn::LoadU(Indices(), &notes.in_run[static_cast<std::size_t>(first)]);
  const Vector along = hn::ConvertTo(d, k);
  const auto is_odd = hn::MaskFromVec(hn::BitCast(d, hn::Neg(hn::And(k, hn::Set(Indices(), 1)))));
  const Vector t = run_position(segment, along, is_odd);
  const Vector z = hn::Add(segment.number(&LeafRow::z_start), hn::Mul(t, segment.number(&LeafRow::z_length)));
  const auto [point, tangent] = on_curve(segment, t);
  const Vector3 across = segment.vector(&LeafRow::across);
  const Vector3 fallback = normalized(cross(tangent, {set(0), set(1), set(0)}), {set(1), set(0), set(0)});
  const Vector3 flat = normalized(cross(across, tangent), fallback);
  const SineCosine roll =
      sine_cosine_deg(run_roll_deg(segment, along, is_odd, p.rotate[level_index(stem_level + 1)] < 0));
  const Vector3 right = flat * roll.cosine + cross(tangent, flat) * roll.sine;
  const Vector3 outward = cross(tangent, right);
  const SineCosine down = sine_cosine_deg(down_angle_at(
      z, column(notes.jitter), p, level_index(stem_level + 1), p.base_size[level_index(stem_level)]));
  Placed leaf{point + outward * radius_at(segment, z, p.taper[level_index(stem_level)]),
              tangent * down.cosine + outward * down.sine, right};
  if (p.leaf_bend > 0) bend_outwards(leaf, p.leaf_bend);
  return leaf;
}

void store(const Vector3& v, Vec3* to) { hn::StoreInterleaved3(v.x, v.y, v.z, Floats(), &to->x); }

/// Writes whole vectors: up to 7 rows more than there are notes.
void place_all(const LeafNotes& notes, const WeberPennParameters& p, Vec3* position_m, Vec3* axis,
               Vec3* side) {
  const int stem_level = p.level_count() - 1, lanes = static_cast<int>(hn::Lanes(Floats()));
  for (int first = 0; first < notes.count; first += lanes) {
    const Placed leaf = place(notes, first, p, stem_level);
    store(leaf.position, position_m + first);
    store(leaf.axis, axis + first);
    store(leaf.side, side + first);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace espalier {

HWY_EXPORT(place_all);

namespace {

ChildRun without_first(const ChildRun& run) {
  return {.first = run.first + 1,
          .count = run.count - 1,
          .t_start = run.t_start + run.t_step + run.t_odd,
          .t_step = run.t_step,
          .t_odd = -run.t_odd,
          .roll_deg = run.alternate ? -run.roll_deg : run.roll_deg + run.roll_step_deg,
          .roll_step_deg = run.roll_step_deg,
          .alternate = run.alternate};
}

}  // namespace

bool LeafBatch::takes(const GrowingStem& stem, const WeberPennParameters& p) {
  const int level = level_index(stem.level);
  return stem.level > 0 && p.leaf_blos_num > 0 && p.curve_v[level] >= 0 && p.taper[level] < 2;
}

void LeafBatch::add(const GrowingStem& stem, const Segment& segment, ChildPlacer& placer) {
  const float bare = p_.base_size[level_index(stem.level)], z_length = segment.z_end - segment.z_start;
  const auto is_bare = [&](float t) { return segment.z_start + std::clamp(t, 0.f, 1.f) * z_length < bare; };
  if (ChildRun run; placer.next_run(run)) {
    while (run.count > 0 && is_bare(run.t_start)) run = without_first(run);
    note_run(stem, segment, run, 1);
  }
  for (ChildSlot slot; placer.next_slot(slot);)
    if (slot.grown_fraction > 0 && !is_bare(slot.t))
      note_run(stem, segment, {.first = slot.index, .count = 1, .t_start = slot.t, .roll_deg = slot.roll_deg},
               slot.grown_fraction);
}

void LeafBatch::note_run(const GrowingStem& stem, const Segment& segment, ChildRun run,
                         float grown_fraction) {
  const bool has_jitter = p_.down_angle_v[level_index(stem.level + 1)] != 0,
             has_blossoms = p_.blossom_rate > 0;
  const float growth = leaf_growth(stem, grown_fraction, p_);
  for (int k = 0; k < run.count;) {
    if (notes_.count == LeafNotes::kMost) flush();
    const int row = notes_.rows++, end = std::min(run.count, k + LeafNotes::kMost - notes_.count);
    notes_.row[static_cast<std::size_t>(row)] = {
        segment.start_m,     segment.handle_out_m,
        segment.handle_in_m, segment.end_m,
        segment.end.forward, cross(segment.end.forward, segment.end.right),
        stem.radius_m,       stem.length_m,
        segment.z_start,     segment.z_end - segment.z_start,
        run.t_start,         run.t_step,
        run.t_odd,           run.roll_deg,
        run.roll_step_deg};
    for (; k < end; ++k) {
      const auto i = static_cast<std::size_t>(notes_.count++);
      notes_.row_index[i] = row;
      notes_.in_run[i] = k;
      notes_.growth[i] = growth;
      notes_.jitter[i] = has_jitter ? draw_signed(stem.key, Draw::child_down_angle, run.first + k) : 0;
      notes_.kind[i] = has_blossoms ? leaf_kind(stem, run.first + k, p_) : LeafKind::leaf;
    }
  }
}

void LeafBatch::append_sizes() {
  const std::size_t before = leaves_.size(), count = static_cast<std::size_t>(notes_.count);
  leaves_.kind.insert(leaves_.kind.end(), notes_.kind.begin(), notes_.kind.begin() + notes_.count);
  leaves_.length_m.resize(before + count);
  leaves_.width_m.resize(before + count);
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_leaf = notes_.kind[i] == LeafKind::leaf;
    leaves_.length_m[before + i] = (is_leaf ? p_.leaf_scale : p_.blossom_scale) * notes_.growth[i];
    leaves_.width_m[before + i] = leaves_.length_m[before + i] * (is_leaf ? p_.leaf_scale_x : 1);
  }
}

void LeafBatch::flush() {
  const std::size_t before = leaves_.position_m.size(),
                    after = before + static_cast<std::size_t>(notes_.count);
  for (std::vector<Vec3>* column : {&leaves_.position_m, &leaves_.axis, &leaves_.side})
    column->resize(after + LeafNotes::kMost % 8 + 8);
  HWY_DYNAMIC_DISPATCH(place_all)
  (notes_, p_, &leaves_.position_m[before], &leaves_.axis[before], &leaves_.side[before]);
  for (std::vector<Vec3>* column : {&leaves_.position_m, &leaves_.axis, &leaves_.side}) column->resize(after);
  append_sizes();
  notes_.count = notes_.rows = 0;
}

}  // namespace espalier
#endif
