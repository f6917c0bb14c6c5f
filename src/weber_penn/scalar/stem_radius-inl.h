// stem_radius_m for a vector of places on one stem, above the flare of trunks and where the stem does not
// swell periodically (taper < 2): the same bits. For files that Highway compiles once per instruction set.
#if defined(ESPALIER_WEBER_PENN_STEM_RADIUS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ESPALIER_WEBER_PENN_STEM_RADIUS_INL_H
#undef ESPALIER_WEBER_PENN_STEM_RADIUS_INL_H
#else
#define ESPALIER_WEBER_PENN_STEM_RADIUS_INL_H
#endif

#include <espalier/core/vector_math-inl.h>
#include <espalier/weber_penn/scalar/along_curve-inl.h>
#include <espalier/weber_penn/scalar/stem.h>

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {

/// The radius at z = 0 (base) … 1 (tip), but for radius_along.
inline Vector tapered_radius_at(const GrowingStem& stem, Vector z, float taper) {
  const Vector base = set(stem.radius_m);
  const Vector cone = hn::Mul(base, hn::Sub(set(1), hn::Mul(set(taper < 1 ? taper : 2 - taper), z)));
  if (taper < 1) return cone;
  const Vector to_tip = hn::Mul(hn::Sub(set(1), z), set(stem.length_m));
  const Vector across = hn::Sub(to_tip, cone);
  const Vector squared = hn::Sub(hn::Mul(cone, cone), hn::Mul(across, across));
  return hn::IfThenElse(hn::Ge(to_tip, cone), cone, hn::Sqrt(hn::Max(squared, set(0))));
}

/// The radius at z = 0 (base) … 1 (tip).
HWY_INLINE Vector radius_at(const GrowingStem& stem, Vector z, const WeberPennParameters& p) {
  const auto level = static_cast<std::size_t>(level_index(stem.level));
  const Vector tapered = tapered_radius_at(stem, z, p.taper[level]);
  const AlongCurve& along = p.curves.radius_along[level];
  return along.is_neutral ? tapered : hn::Mul(tapered, hn::Max(set(0), curve_at(along, z)));
}

}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#endif
