// Vectors of waiting children: reading and writing their columns, and their frames on the parent's axis. For
// files that Highway compiles once per instruction set. No #pragma once: see Highway's guide.
#if defined(ESPALIER_WEBER_PENN_WAITING_CHILDREN_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ESPALIER_WEBER_PENN_WAITING_CHILDREN_INL_H
#undef ESPALIER_WEBER_PENN_WAITING_CHILDREN_INL_H
#else
#define ESPALIER_WEBER_PENN_WAITING_CHILDREN_INL_H
#endif

#include <espalier/core/vector_math-inl.h>
#include <espalier/weber_penn/simd/waiting_children.h>

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {

inline void store(const Vector3& v, WaitingChildren::Columns3& columns, std::size_t at) {
  const Floats d;
  hn::StoreU(v.x, d, &columns.x[at]);
  hn::StoreU(v.y, d, &columns.y[at]);
  hn::StoreU(v.z, d, &columns.z[at]);
}

inline Vector3 load(const WaitingChildren::Columns3& columns, std::size_t at) {
  const Floats d;
  return {hn::Load(d, &columns.x[at]), hn::Load(d, &columns.y[at]), hn::Load(d, &columns.z[at])};
}

/// ChildPlacer::frame_at: unit tangents, and `right` before the roll.
HWY_INLINE void make_frames(WaitingChildren& children, std::size_t at) {
  const Vector3 along = load(children.tangent, at);
  const Vector3 tangent = along * hn::Div(set(1), hn::Sqrt(dot(along, along)));
  const Vector3 right = cross(load(children.across, at), tangent);
  const Vector norm = hn::Sqrt(dot(right, right));
  const auto has_direction = hn::Gt(norm, set(1e-12f));
  Vector3 unit = right * hn::Div(set(1), norm);
  if (!hn::AllTrue(Floats(), has_direction))
    unit = choose(has_direction, unit,
                  normalized(cross(tangent, {set(0), set(1), set(0)}), {set(1), set(0), set(0)}));
  store(tangent, children.tangent, at);
  store(unit, children.right, at);
}

/// A child as it leaves its parent: across it, out of it, and along itself.
struct TurnedChildren {
  Vector3 right, outward, heading;
};

/// Sines and cosines of the children's angles.
HWY_INLINE void make_turns(WaitingChildren& children, std::size_t at) {
  const Floats d;
  const SineCosine roll = sine_cosine_deg(hn::Load(d, &children.roll_deg[at])),
                   down = sine_cosine_deg(hn::Load(d, &children.down_deg[at]));
  hn::Store(roll.sine, d, &children.roll_sine[at]);
  hn::Store(roll.cosine, d, &children.roll_cosine[at]);
  hn::Store(down.sine, d, &children.down_sine[at]);
  hn::Store(down.cosine, d, &children.down_cosine[at]);
}

/// Rolls the frames about the parent, and turns them down from it.
HWY_INLINE TurnedChildren turned(const WaitingChildren& children, std::size_t at) {
  const Floats d;
  const auto number = [&](const auto& column) { return hn::Load(d, &column[at]); };
  const Vector3 tangent = load(children.tangent, at), flat = load(children.right, at);
  const Vector3 right =
      flat * number(children.roll_cosine) + cross(tangent, flat) * number(children.roll_sine);
  const Vector3 outward = cross(tangent, right);
  return {right, outward, tangent * number(children.down_cosine) + outward * number(children.down_sine)};
}

}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#endif
