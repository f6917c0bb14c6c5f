// Making child stems, see twig_batch.h. Equations as in grow.cpp.
#undef HWY_TARGET_INCLUDE
// NOLINTNEXTLINE(bugprone-macro-parentheses): a name of a file
#define HWY_TARGET_INCLUDE <espalier/weber_penn/simd/twig_batch.cpp>
#include <hwy/foreach_target.h>
// Highway's order: foreach_target before the files it compiles again.
#include <hwy/highway.h>

#include <algorithm>

#include <espalier/weber_penn/scalar/child_stem.h>
#include <espalier/weber_penn/scalar/pruning.h>
#include <espalier/weber_penn/simd/twig_batch.h>
#include <espalier/weber_penn/simd/waiting_children-inl.h>

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {
namespace {

/// child_length_m of a child of a branch, and its radius before pruning [child_stem.h].
void make_sizes(const WaitingChildren& children, const TwigBatchParents& parents,
                const WeberPennParameters& p, int level, std::size_t at, MadeStems& made) {
  const Floats d;
  const Vector parent_m = hn::Load(d, &parents.length_m[at]);
  const Vector to_tip_m = hn::Sub(parent_m, hn::Mul(set(0.7f), hn::Load(d, &children.offset_m[at])));
  const Vector length_m =
      hn::Mul(hn::Load(d, &children.growth[at]), hn::Mul(hn::Load(d, &parents.child_max[at]), to_tip_m));
  const Vector ratio = power(hn::Max(hn::Div(length_m, parent_m), set(1e-30f)), p.ratio_power);
  const Vector scaled_m =
      hn::Mul(hn::Mul(set(p.radius_mod[level_index(level)]), hn::Load(d, &parents.radius_m[at])), ratio);
  hn::Store(length_m, d, &made.length_m[at]);
  hn::Store(
      hn::Min(hn::Load(d, &children.parent_radius_m[at]), hn::Max(set(p.least_radius_mm / 1000), scaled_m)),
      d, &made.radius_m[at]);
}

/// Rolled, turned down and renormalized, as close to the parent's surface as is safe.
void make_turtles(const WaitingChildren& children, std::size_t at, MadeStems& made) {
  const Floats d;
  const TurnedChildren child = turned(children, at);
  const Vector3 forward = child.heading * hn::Div(set(1), hn::Sqrt(dot(child.heading, child.heading)));
  const Vector3 across = child.right - forward * dot(forward, child.right);
  const Vector depth_m = hn::Sub(hn::Load(d, &children.parent_radius_m[at]), hn::Load(d, &made.radius_m[at]));
  store(load(children.point, at) + child.outward * depth_m, made.position, at);
  store(forward, made.forward, at);
  store(across * hn::Div(set(1), hn::Sqrt(dot(across, across))), made.right, at);
}

void make_stems(const WeberPennParameters& p, int level, const TwigBatchParents& parents,
                WaitingChildren& children, MadeStems& made) {
  const auto count = static_cast<std::size_t>(children.count), lanes = hn::Lanes(Floats());
  for (std::size_t at = 0; at < count; at += lanes) make_frames(children, at);
  for (std::size_t at = 0; at < count; at += lanes) make_turns(children, at);
  for (std::size_t at = 0; at < count; at += lanes) make_sizes(children, parents, p, level, at, made);
  for (std::size_t at = 0; at < count; at += lanes) make_turtles(children, at, made);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace espalier {

HWY_EXPORT(make_stems);

bool TwigBatch::supports(const GrowingStem& parent, const WeberPennParameters& p) {
  return p.branches[level_index(parent.level + 1)] >= 0 && takes_children_of(parent.level, p);
}

void TwigBatch::note(const GrowingStem& stem, int first_row, int count) {
  parent_level_ = stem.level;
  for (std::size_t row = static_cast<std::size_t>(first_row), end = row + static_cast<std::size_t>(count);
       row < end; ++row) {
    parents_.length_m[row] = stem.length_m;
    parents_.child_max[row] = stem.child_max;
    parents_.radius_m[row] = stem.radius_m;
    parents_.key[row] = stem.key;
    parents_.tree[row] = stem.tree;
    parents_.index[row] = parent_index_;
    parents_.path_length[row] = stem.path_length;
  }
}

/// Not pruned yet. Filled in where it stays: copies would wait for what was just written.
GrowingStem& TwigBatch::add_made(std::size_t row) {
  const auto vec3 = [&](const WaitingChildren::Columns3& c) { return Vec3{c.x[row], c.y[row], c.z[row]}; };
  GrowingStem& stem = stems_.emplace_back();
  stem.key = child_key(parents_.key[row], static_cast<std::uint64_t>(waiting_.index[row]));
  stem.level = parent_level_ + 1;
  stem.parent = stem.origin = parents_.index[row];
  stem.child_index = static_cast<std::uint32_t>(waiting_.index[row]);
  stem.path_length = parents_.path_length[row] + 1;
  stem.tree = parents_.tree[row];
  stem.turtle = {vec3(made_.position), vec3(made_.forward), vec3(made_.right)};
  stem.length_m = made_.length_m[row];
  stem.radius_m = made_.radius_m[row];
  stem.child_max = drawn_child_max(stem, p_);
  stem.offset_m = waiting_.offset_m[row];
  stem.parent_length_m = parents_.length_m[row];
  stem.parent_child_max = parents_.child_max[row];
  return stem;
}

/// No point of a stem that does not wind is further from its start than it is long.
bool TwigBatch::surely_fits(const GrowingStem& stem) const {
  constexpr float kRounding = 1.001f;
  return floor_ && p_.curve_v[level_index(stem.level)] >= 0 &&
         floor_->surely_holds_ball(stem.turtle.position_m, kRounding * stem.length_m, stem.tree.scale_m);
}

void TwigBatch::flush() {
  HWY_DYNAMIC_DISPATCH(make_stems)(p_, parent_level_ + 1, parents_, waiting_, made_);
  const float thinnest_m = thinnest_parent_m(p_);
  for (std::size_t row = 0; row < static_cast<std::size_t>(waiting_.count); ++row) {
    if (waiting_.parent_radius_m[row] < thinnest_m || made_.length_m[row] < kShortestStemM) continue;
    GrowingStem& stem = add_made(row);
    if (surely_fits(stem)) continue;
    const float length_m = pruned_length_m(stem, p_, settings_.prune_to);
    if (length_m == stem.length_m) continue;
    stem.length_m = length_m;
    stem.radius_m = child_radius_m(length_m, parents_.length_m[row], parents_.radius_m[row],
                                   waiting_.parent_radius_m[row], stem.level, p_);
    if (length_m < kShortestStemM) stems_.pop_back();
  }
  waiting_.count = 0;
}

}  // namespace espalier
#endif
