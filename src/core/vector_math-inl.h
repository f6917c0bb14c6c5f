// Sine, cosine and arc tangent of float vectors, for files that Highway compiles once per instruction set.
// Polynomials of Cephes (Moshier 1992: sinf.c, cosf.c, atanf.c), errors below 3e-7. Products and sums are
// rounded apart, never fused: all instruction sets give the same bits. No #pragma once: see Highway's guide.
#if defined(ESPALIER_CORE_VECTOR_MATH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ESPALIER_CORE_VECTOR_MATH_INL_H
#undef ESPALIER_CORE_VECTOR_MATH_INL_H
#else
#define ESPALIER_CORE_VECTOR_MATH_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Eight floats on AVX2 and AVX-512, four on SSE: enough work for short stems, the same order of sums.
using Floats = hn::CappedTag<float, 8>;
using Vector = hn::Vec<Floats>;
constexpr std::size_t kMostLanes = 8;

inline Vector set(float value) { return hn::Set(Floats(), value); }

/// first, first + 1, … (Highway's Iota fills them in one by one where it does not know the first).
inline hn::Vec<hn::RebindToSigned<Floats>> counted_from(std::int32_t first) {
  const hn::RebindToSigned<Floats> di;
  alignas(64) static constexpr std::int32_t kLanes[kMostLanes] = {0, 1, 2, 3, 4, 5, 6, 7};
  return hn::Add(hn::Load(di, kLanes), hn::Set(di, first));
}

struct SineCosine {
  Vector sine, cosine;
};

/// Takes an angle in degrees; whole quarter turns are taken off without rounding.
inline SineCosine sine_cosine_deg(Vector angle_deg) {
  const Floats d;
  const Vector quarters = hn::Round(hn::Mul(angle_deg, set(1.0f / 90)));
  const Vector x = hn::Mul(hn::Sub(angle_deg, hn::Mul(quarters, set(90))), set(0.017453292519943295f));
  const Vector z = hn::Mul(x, x);
  Vector s = hn::Sub(set(8.3321608736e-3f), hn::Mul(z, set(1.9515295891e-4f)));
  s = hn::Sub(hn::Mul(s, z), set(1.6666654611e-1f));
  s = hn::Add(hn::Mul(hn::Mul(s, z), x), x);
  Vector c = hn::Sub(hn::Mul(z, set(2.443315711809948e-5f)), set(1.388731625493765e-3f));
  c = hn::Add(hn::Mul(c, z), set(4.166664568298827e-2f));
  c = hn::Add(hn::Sub(hn::Mul(hn::Mul(c, z), z), hn::Mul(z, set(0.5f))), set(1));
  const hn::RebindToSigned<Floats> di;
  const auto quadrant = hn::ConvertTo(di, quarters);
  const auto is_odd = hn::MaskFromVec(hn::BitCast(d, hn::Neg(hn::And(quadrant, hn::Set(di, 1)))));
  // Bit 1 of the quadrant is the sign of the sine, that of the next quadrant the sign of the cosine.
  const auto sign = [&](auto v) { return hn::BitCast(d, hn::ShiftLeft<30>(hn::And(v, hn::Set(di, 2)))); };
  const Vector sine = hn::IfThenElse(is_odd, c, s), cosine = hn::IfThenElse(is_odd, s, c);
  return {hn::Xor(sine, sign(quadrant)), hn::Xor(cosine, sign(hn::Add(quadrant, hn::Set(di, 1))))};
}

/// The angle of (x, y) in degrees, in [-180, 180]; 0 for the origin.
inline Vector arc_tangent2_deg(Vector y, Vector x) {
  const Floats d;
  const Vector zero = hn::Zero(d), ax = hn::Abs(x), ay = hn::Abs(y);
  const Vector small = hn::Min(ax, ay), large = hn::Max(ax, ay);
  const auto past_22_deg = hn::Gt(small, hn::Mul(large, set(0.41421356f)));
  const Vector numerator = hn::IfThenElse(past_22_deg, hn::Sub(small, large), small);
  const Vector denominator = hn::IfThenElse(past_22_deg, hn::Add(small, large), large);
  const Vector r = hn::IfThenElse(hn::Gt(large, zero), hn::Div(numerator, denominator), zero);
  const Vector z = hn::Mul(r, r);
  Vector p = hn::Sub(hn::Mul(z, set(8.05374449538e-2f)), set(1.38776856032e-1f));
  p = hn::Add(hn::Mul(p, z), set(1.99777106478e-1f));
  p = hn::Sub(hn::Mul(p, z), set(3.33329491539e-1f));
  p = hn::Add(hn::Mul(hn::Mul(p, z), r), r);
  Vector angle = hn::Mul(p, set(57.29577951308232f));
  angle = hn::IfThenElse(past_22_deg, hn::Add(angle, set(45)), angle);
  angle = hn::IfThenElse(hn::Gt(ay, ax), hn::Sub(set(90), angle), angle);
  angle = hn::IfThenElse(hn::Lt(x, zero), hn::Sub(set(180), angle), angle);
  return hn::CopySign(angle, y);
}

/// Takes positive numbers that are neither infinite nor subnormal (Cephes: logf.c).
inline Vector logarithm2(Vector x) {
  const Floats d;
  const hn::RebindToSigned<Floats> di;
  const auto bits = hn::BitCast(di, x);
  const auto half = hn::BitCast(d, hn::Or(hn::And(bits, hn::Set(di, 0x007fffff)), hn::Set(di, 0x3f000000)));
  const auto is_low = hn::Lt(half, set(0.70710678f));  // mantissas in [√½, √2)
  const Vector exponent = hn::ConvertTo(d, hn::Sub(hn::ShiftRight<23>(bits), hn::Set(di, 126)));
  const Vector e = hn::Sub(exponent, hn::IfThenElseZero(is_low, set(1)));
  const Vector f = hn::Sub(hn::IfThenElse(is_low, hn::Add(half, half), half), set(1));
  Vector p = set(7.0376836292e-2f);
  for (const float coefficient : {-1.1514610310e-1f, 1.1676998740e-1f, -1.2420140846e-1f, 1.4249322787e-1f,
                                  -1.6668057665e-1f, 2.0000714765e-1f, -2.4999993993e-1f, 3.3333331174e-1f})
    p = hn::Add(hn::Mul(p, f), set(coefficient));
  const Vector z = hn::Mul(f, f);
  const Vector natural = hn::Add(f, hn::Sub(hn::Mul(hn::Mul(p, f), z), hn::Mul(z, set(0.5f))));
  return hn::Add(e, hn::Mul(natural, set(1.44269504f)));
}

/// 2^x; x is clamped to what is no subnormal number (Cephes: exp2f.c).
inline Vector power_of_2(Vector x) {
  const Floats d;
  const hn::RebindToSigned<Floats> di;
  x = hn::Min(hn::Max(x, set(-126)), set(127));
  const Vector whole = hn::Round(x), f = hn::Sub(x, whole);
  Vector p = set(1.535336188319500e-4f);
  for (const float coefficient : {1.339887440266574e-3f, 9.618437357674640e-3f, 5.550332471162809e-2f,
                                  2.402264791363012e-1f, 6.931472028550421e-1f, 1.0f})
    p = hn::Add(hn::Mul(p, f), set(coefficient));
  const auto scale = hn::ShiftLeft<23>(hn::Add(hn::ConvertTo(di, whole), hn::Set(di, 127)));
  return hn::Mul(p, hn::BitCast(d, scale));
}

/// x^exponent for positive x, to about six digits.
inline Vector power(Vector x, float exponent) { return power_of_2(hn::Mul(logarithm2(x), set(exponent))); }

/// Three vectors: a point or direction a lane.
struct Vector3 {
  Vector x, y, z;
};

inline Vector3 operator+(const Vector3& a, const Vector3& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
inline Vector3 operator-(const Vector3& a, const Vector3& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
inline Vector3 operator*(const Vector3& a, Vector s) {
  return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)};
}
inline Vector dot(const Vector3& a, const Vector3& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
inline Vector3 cross(const Vector3& a, const Vector3& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}
inline Vector3 choose(hn::Mask<Floats> where, const Vector3& yes, const Vector3& no) {
  return {hn::IfThenElse(where, yes.x, no.x), hn::IfThenElse(where, yes.y, no.y),
          hn::IfThenElse(where, yes.z, no.z)};
}
/// The unit vector along `a`, or `fallback` where `a` is too short to have a direction.
inline Vector3 normalized(const Vector3& a, const Vector3& fallback) {
  const Vector norm = hn::Sqrt(dot(a, a));
  return choose(hn::Gt(norm, set(1e-12f)), a * hn::Div(set(1), norm), fallback);
}

}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#endif
