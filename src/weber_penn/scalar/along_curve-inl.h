// AlongCurve::at for a vector of places: the same bits. For files that Highway compiles once per instruction
// set.
#if defined(ESPALIER_WEBER_PENN_ALONG_CURVE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ESPALIER_WEBER_PENN_ALONG_CURVE_INL_H
#undef ESPALIER_WEBER_PENN_ALONG_CURVE_INL_H
#else
#define ESPALIER_WEBER_PENN_ALONG_CURVE_INL_H
#endif

#include <espalier/core/vector_math-inl.h>
#include <espalier/weber_penn/table/along_curves.h>

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {

/// The curve at x; of pieces that fit into a vector, the coefficients are looked up by a permutation.
HWY_INLINE Vector curve_at(const AlongCurve& along, Vector x) {
  const Floats d;
  const hn::RebindToSigned<Floats> di;
  const Vector u = hn::Mul(hn::Min(hn::Max(x, set(0)), set(1)), set(AlongCurve::kPieces));
  const auto piece = hn::Min(hn::ConvertTo(di, u), hn::Set(di, AlongCurve::kPieces - 1));
  const Vector t = hn::Sub(u, hn::ConvertTo(d, piece));
  const auto coefficient = [&](std::size_t power) {
    const float* const of_pieces = along.coefficients[power].data();
    if constexpr (hn::MaxLanes(Floats()) >= AlongCurve::kPieces)
      return hn::TableLookupLanes(hn::LoadDup128(d, of_pieces), hn::IndicesFromVec(d, piece));
    else
      return hn::GatherIndex(d, of_pieces, piece);
  };
  const Vector cubic = hn::Add(hn::Mul(coefficient(3), t), coefficient(2));
  return hn::Add(hn::Mul(hn::Add(hn::Mul(cubic, t), coefficient(1)), t), coefficient(0));
}

}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#endif
