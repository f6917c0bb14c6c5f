// Placing noted leaves, see leaf_batch.h. Equations as in children.cpp and leaf_placement.cpp.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "weber_penn/leaf_batch.cpp"
#include <hwy/foreach_target.h>
// Highway's order: foreach_target before the files it compiles again.
#include <hwy/highway.h>

#include "core/vector_math-inl.h"
#include "weber_penn/leaf_batch.h"
#include "weber_penn/leaf_placement.h"

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {
namespace {

using Indices = hn::RebindToSigned<Floats>;

/// Gathers one member of each lane's segment.
class SegmentLanes {
 public:
  SegmentLanes(const LeafNotes& notes, int first)
      : rows_(&notes.segment[0].start_m.x),
        index_(hn::Mul(hn::LoadU(Indices(), &notes.segment_index[static_cast<std::size_t>(first)]),
                       hn::Set(Indices(), kStride))) {}

  Vector number(float LeafSegment::*member) const {
    static const LeafSegment kRow{};
    return at(static_cast<int>(&(kRow.*member) - &kRow.start_m.x));
  }
  Vector3 vector(Vec3 LeafSegment::*member) const {
    static const LeafSegment kRow{};
    const int column = static_cast<int>(&(kRow.*member).x - &kRow.start_m.x);
    return {at(column), at(column + 1), at(column + 2)};
  }

 private:
  static constexpr int kStride = sizeof(LeafSegment) / sizeof(float);
  Vector at(int column) const { return hn::GatherIndex(Floats(), rows_ + column, index_); }

  const float* rows_;
  hn::Vec<Indices> index_;
};

struct Heading {
  Vector3 point, forward;
};

/// Point and tangent of the segments' curves at t.
Heading on_curve(const SegmentLanes& segment, Vector t) {
  const Vector3 a = segment.vector(&LeafSegment::start_m), b = segment.vector(&LeafSegment::handle_out_m),
                c = segment.vector(&LeafSegment::handle_in_m), e = segment.vector(&LeafSegment::end_m);
  const Vector u = hn::Sub(set(1), t), uu = hn::Mul(u, u), tt = hn::Mul(t, t), ut = hn::Mul(u, t);
  const Vector3 derivative = (b - a) * uu + (c - b) * hn::Mul(set(2), ut) + (e - c) * tt;
  return {a * hn::Mul(uu, u) + b * hn::Mul(set(3), hn::Mul(uu, t)) + c * hn::Mul(set(3), hn::Mul(u, tt)) +
              e * hn::Mul(tt, t),
          normalized(derivative, segment.vector(&LeafSegment::heading))};
}

/// stem_radius_m for taper < 2 [stem_radius.cpp].
Vector radius_at(const SegmentLanes& segment, Vector z, float taper) {
  const Vector base = segment.number(&LeafSegment::base_radius_m);
  const Vector cone = hn::Mul(base, hn::Sub(set(1), hn::Mul(set(taper < 1 ? taper : 2 - taper), z)));
  if (taper < 1) return cone;
  const Vector to_tip = hn::Mul(hn::Sub(set(1), z), segment.number(&LeafSegment::stem_length_m));
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

Placed place(const LeafNotes& notes, int first, const WeberPennParameters& p, int stem_level) {
  const Floats d;
  const auto column = [&](const auto& values) {
    return hn::LoadU(d, &values[static_cast<std::size_t>(first)]);
  };
  const SegmentLanes segment(notes, first);
  const Vector z = column(notes.z);
  const auto [point, tangent] = on_curve(segment, column(notes.t));
  const Vector3 across = segment.vector(&LeafSegment::across);
  const Vector3 fallback = normalized(cross(tangent, {set(0), set(1), set(0)}), {set(1), set(0), set(0)});
  const Vector3 flat = normalized(cross(across, tangent), fallback);
  const SineCosine roll = sine_cosine_deg(column(notes.roll_deg));
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

bool LeafBatch::takes(const GrowingStem& stem, const WeberPennParameters& p) {
  const int level = level_index(stem.level);
  return stem.level > 0 && p.leaf_blos_num > 0 && p.curve_v[level] >= 0 && p.taper[level] < 2;
}

void LeafBatch::add(const GrowingStem& stem, const Segment& segment, ChildPlacer& placer) {
  const float bare = p_.base_size[level_index(stem.level)];
  bool is_noted = false;
  for (ChildSlot slot; placer.next_slot(slot);) {
    const float z = segment.z_start + slot.t * (segment.z_end - segment.z_start);
    if (z < bare || !(slot.grown_fraction > 0)) continue;
    if (notes_.count == LeafNotes::kMost) {
      flush();
      is_noted = false;
    }
    if (!is_noted)
      notes_.segment[static_cast<std::size_t>(notes_.segments++)] = {
          segment.start_m, segment.handle_out_m, segment.handle_in_m,
          segment.end_m,   segment.end.forward,  cross(segment.end.forward, segment.end.right),
          stem.radius_m,   stem.length_m};
    is_noted = true;
    note(stem, slot, z);
  }
}

void LeafBatch::note(const GrowingStem& stem, const ChildSlot& slot, float z) {
  const auto i = static_cast<std::size_t>(notes_.count++);
  notes_.t[i] = slot.t;
  notes_.z[i] = z;
  notes_.roll_deg[i] = slot.roll_deg;
  notes_.jitter[i] = draw_signed(stem.key, Draw::child_down_angle, slot.index);
  notes_.segment_index[i] = notes_.segments - 1;
  notes_.growth[i] = leaf_growth(stem, slot.grown_fraction, p_);
  notes_.kind[i] = leaf_kind(stem, slot.index, p_);
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
  notes_.count = notes_.segments = 0;
}

}  // namespace espalier
#endif
