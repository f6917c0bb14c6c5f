// Placing leaves, see leaf_batch.h. Equations as in leaf_placement.cpp.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "weber_penn/leaf_batch.cpp"
#include <hwy/foreach_target.h>
// Highway's order: foreach_target before the files it compiles again.
#include <hwy/highway.h>

#include <algorithm>

#include "weber_penn/leaf_batch.h"
#include "weber_penn/leaf_placement.h"
#include "weber_penn/waiting_children-inl.h"

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {
namespace {

void store(const Vector3& v, Vec3* to) { hn::StoreInterleaved3(v.x, v.y, v.z, Floats(), &to->x); }

/// Where leaves go in the plant.
struct LeafRows {
  Vec3 *position_m, *axis, *side;
};

/// Turns the leaves from their frames.
void turn_leaves(const WaitingChildren& leaves, std::size_t at, const LeafRows& to) {
  const TurnedChildren leaf = turned(leaves, at);
  const Vector radius_m = hn::Load(Floats(), &leaves.parent_radius_m[at]);
  store(load(leaves.point, at) + leaf.outward * radius_m, to.position_m + at);
  store(leaf.heading, to.axis + at);
  store(leaf.right, to.side + at);
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
void place_all(const WeberPennParameters& p, WaitingChildren& leaves, Vec3* position_m, Vec3* axis,
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

HWY_EXPORT(place_all);

bool LeafBatch::takes(const GrowingStem& stem, const WeberPennParameters& p) {
  return p.leaf_blos_num > 0 && takes_children_of(stem.level, p);
}

float LeafBatch::growth(const GrowingStem& stem, float grown_fraction) const {
  return leaf_growth(stem, grown_fraction, p_);
}

void LeafBatch::note(const GrowingStem& stem, int first_row, int count) {
  if (p_.blossom_rate <= 0) return;
  for (std::size_t row = static_cast<std::size_t>(first_row), i = 0; i < static_cast<std::size_t>(count); ++i)
    kind_[row + i] = leaf_kind(stem, waiting_.index[row + i], p_);
}

void LeafBatch::append_sizes() {
  const std::size_t before = leaves_.length_m.size(), count = static_cast<std::size_t>(waiting_.count);
  if (p_.blossom_rate > 0)
    leaves_.kind.insert(leaves_.kind.end(), kind_.begin(), kind_.begin() + waiting_.count);
  else
    leaves_.kind.resize(before + count, LeafKind::leaf);
  leaves_.length_m.resize(before + count);
  leaves_.width_m.resize(before + count);
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_leaf = leaves_.kind[before + i] == LeafKind::leaf;
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
