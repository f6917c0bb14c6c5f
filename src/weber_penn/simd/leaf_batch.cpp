// Placing leaves, see leaf_batch.h. Equations as in leaf_placement.cpp.
#undef HWY_TARGET_INCLUDE
// NOLINTNEXTLINE(bugprone-macro-parentheses): a name of a file
#define HWY_TARGET_INCLUDE <espalier/weber_penn/simd/leaf_batch.cpp>
#include <hwy/foreach_target.h>
// Highway's order: foreach_target before the files it compiles again.
#include <hwy/highway.h>

#include <algorithm>

#include <espalier/weber_penn/scalar/leaf_placement.h>
#include <espalier/weber_penn/simd/leaf_batch.h>
#include <espalier/weber_penn/simd/waiting_children-inl.h>

#ifndef ESPALIER_WEBER_PENN_LEAF_ROWS
#define ESPALIER_WEBER_PENN_LEAF_ROWS
namespace espalier {
/// Where leaves go in the plant.
struct LeafRows {
  Vec3 *position_m, *axis, *side;
};
constexpr std::size_t kMostBeyond = 8;  ///< rows written beyond the last leaf
}  // namespace espalier
#endif

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {
namespace {

void store(const Vector3& v, Vec3* to) { hn::StoreInterleaved3(v.x, v.y, v.z, Floats(), &to->x); }

struct LeafVectors {
  Vector3 position, axis, side;
};

/// Turns leaves from their frames.
HWY_INLINE LeafVectors turned_leaves(const WaitingChildren& leaves, std::size_t at) {
  const TurnedChildren leaf = turned(leaves, at);
  const Vector radius_m = hn::Load(Floats(), &leaves.parent_radius_m[at]);
  return {load(leaves.point, at) + leaf.outward * radius_m, leaf.heading, leaf.right};
}

Vector3 turned_about_z(const Vector3& v, const SineCosine& turn) {
  return {hn::Sub(hn::Mul(v.x, turn.cosine), hn::Mul(v.y, turn.sine)),
          hn::Add(hn::Mul(v.x, turn.sine), hn::Mul(v.y, turn.cosine)), v.z};
}

/// leaf_bend turns leaves about z by a share of the angle between their normal and the way out
/// [leaf_placement.cpp]: that angle, in the place of the roll.
HWY_INLINE void find_bends(WaitingChildren& leaves, std::size_t at, float leaf_bend) {
  const Vector3 normal = cross(load(leaves.right, at), load(leaves.tangent, at));
  const Vector3 position = load(leaves.point, at);
  const Vector sine = hn::Sub(hn::Mul(normal.x, position.y), hn::Mul(normal.y, position.x));
  const Vector cosine = hn::Add(hn::Mul(normal.x, position.x), hn::Mul(normal.y, position.y));
  hn::Store(hn::Mul(set(leaf_bend), arc_tangent2_deg(sine, cosine)), Floats(), &leaves.roll_deg[at]);
}

/// Leaves in the plant. Writes whole vectors: up to 7 rows more than there are leaves.
struct InRows {
  const LeafRows& to;

  HWY_INLINE void operator()(const LeafVectors& leaf, std::size_t at) const {
    store(leaf.position, to.position_m + at);
    store(leaf.axis, to.axis + at);
    store(leaf.side, to.side + at);
  }
};

/// Leaves in the columns that they come from.
struct InColumns {
  WaitingChildren& leaves;

  HWY_INLINE void operator()(const LeafVectors& leaf, std::size_t at) const {
    store(leaf.position, leaves.point, at);
    store(leaf.axis, leaves.tangent, at);
    store(leaf.side, leaves.right, at);
  }
};

template <typename Put>
void place_all(const WeberPennParameters& p, WaitingChildren& leaves, const Put& put) {
  const auto count = static_cast<std::size_t>(leaves.count), lanes = hn::Lanes(Floats());
  for (std::size_t at = 0; at < count; at += lanes) make_frames(leaves, at);
  for (std::size_t at = 0; at < count; at += lanes) make_turns(leaves, at);
  if (p.leaf_bend <= 0) {
    for (std::size_t at = 0; at < count; at += lanes) put(turned_leaves(leaves, at), at);
    return;
  }
  const InColumns in_columns{leaves};
  for (std::size_t at = 0; at < count; at += lanes) in_columns(turned_leaves(leaves, at), at);
  for (std::size_t at = 0; at < count; at += lanes) find_bends(leaves, at, p.leaf_bend);
  for (std::size_t at = 0; at < count; at += lanes) {
    const SineCosine turn = sine_cosine_deg(hn::Load(Floats(), &leaves.roll_deg[at]));
    put({load(leaves.point, at), turned_about_z(load(leaves.tangent, at), turn),
         turned_about_z(load(leaves.right, at), turn)},
        at);
  }
}

void place_in_rows(const WeberPennParameters& p, WaitingChildren& leaves, const LeafRows& to) {
  place_all(p, leaves, InRows{to});
}

/// Growths become lengths, offsets widths.
void place_in_columns(const WeberPennParameters& p, WaitingChildren& leaves) {
  place_all(p, leaves, InColumns{leaves});
  const Floats d;
  for (std::size_t at = 0; at < static_cast<std::size_t>(leaves.count); at += hn::Lanes(d)) {
    const Vector length_m = hn::Mul(set(p.leaf_scale), hn::Load(d, &leaves.growth[at]));
    hn::Store(length_m, d, &leaves.growth[at]);
    hn::Store(hn::Mul(length_m, set(p.leaf_scale_x)), d, &leaves.offset_m[at]);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace espalier {

HWY_EXPORT(place_in_rows);
HWY_EXPORT(place_in_columns);

bool LeafBatch::supports(const GrowingStem& stem, const WeberPennParameters& p) {
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
  leaves_.length_m.resize(before + count);
  leaves_.width_m.resize(before + count);
  float *const length_m = &leaves_.length_m[before], *const width_m = &leaves_.width_m[before];
  if (p_.blossom_rate <= 0) {
    leaves_.kind.resize(before + count, LeafKind::leaf);
    for (std::size_t i = 0; i < count; ++i) length_m[i] = p_.leaf_scale * waiting_.growth[i];
    for (std::size_t i = 0; i < count; ++i) width_m[i] = length_m[i] * p_.leaf_scale_x;
    return;
  }
  leaves_.kind.insert(leaves_.kind.end(), kind_.begin(), kind_.begin() + waiting_.count);
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_leaf = kind_[i] == LeafKind::leaf;
    length_m[i] = (is_leaf ? p_.leaf_scale : p_.blossom_scale) * waiting_.growth[i];
    width_m[i] = length_m[i] * (is_leaf ? p_.leaf_scale_x : 1);
  }
}

void LeafBatch::give() {
  HWY_DYNAMIC_DISPATCH(place_in_columns)(p_, waiting_);
  const auto columns = [](const WaitingChildren::Columns3& c) {
    return LeafColumns::Columns3{c.x.data(), c.y.data(), c.z.data()};
  };
  const auto count = static_cast<std::size_t>(waiting_.count);
  sink_->take({columns(waiting_.point), columns(waiting_.tangent), columns(waiting_.right),
               waiting_.growth.data(), waiting_.offset_m.data(), count, static_cast<int>(p_.leaf_shape)});
  given_ += count;
}

void LeafBatch::append() {
  const std::size_t before = leaves_.position_m.size(),
                    after = before + static_cast<std::size_t>(waiting_.count);
  const auto resize = [&](std::size_t size) {
    for (std::vector<Vec3>* column : {&leaves_.position_m, &leaves_.axis, &leaves_.side})
      column->resize(size);
  };
  resize(after + kMostBeyond);
  HWY_DYNAMIC_DISPATCH(place_in_rows)
  (p_, waiting_, {&leaves_.position_m[before], &leaves_.axis[before], &leaves_.side[before]});
  resize(after);
  append_sizes();
}

void LeafBatch::flush() {
  if (waiting_.count == 0) return;
  if (sink_ != nullptr)
    give();
  else
    append();
  waiting_.count = 0;
}

}  // namespace espalier
#endif
