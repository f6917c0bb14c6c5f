#include <fmt/format.h>
#include <sleef.h>

#include <espalier/libm/libm.h>

// The signatures are those of the C library; compiled with -fno-builtin, so that no body becomes a call of
// itself. cinz: the forms that give the same bits with every instruction set.
#define ESPALIER_UNARY(NAME, ERROR)                                                  \
  double NAME(double x) noexcept { return Sleef_cinz_##NAME##d1_##ERROR##purec(x); } \
  float NAME##f(float x) noexcept { return Sleef_cinz_##NAME##f1_##ERROR##purec(x); }
#define ESPALIER_BINARY(NAME, ERROR)                                                              \
  double NAME(double x, double y) noexcept { return Sleef_cinz_##NAME##d1_##ERROR##purec(x, y); } \
  float NAME##f(float x, float y) noexcept { return Sleef_cinz_##NAME##f1_##ERROR##purec(x, y); }

extern "C" {

ESPALIER_UNARY(exp, u10)
ESPALIER_UNARY(exp2, u10)
ESPALIER_UNARY(exp10, u10)
ESPALIER_UNARY(expm1, u10)
ESPALIER_UNARY(log, u10)
ESPALIER_UNARY(log2, u10)
ESPALIER_UNARY(log10, u10)
ESPALIER_UNARY(log1p, u10)
ESPALIER_BINARY(pow, u10)
ESPALIER_UNARY(cbrt, u10)
ESPALIER_BINARY(hypot, u05)

ESPALIER_UNARY(sin, u10)
ESPALIER_UNARY(cos, u10)
ESPALIER_UNARY(tan, u10)
ESPALIER_UNARY(asin, u10)
ESPALIER_UNARY(acos, u10)
ESPALIER_UNARY(atan, u10)
ESPALIER_BINARY(atan2, u10)

// Compilers make one call of a sine and a cosine of the same angle.
void sincos(double x, double* sine, double* cosine) noexcept {
  const Sleef_double_2 both = Sleef_cinz_sincosd1_u10purec(x);
  *sine = both.x;
  *cosine = both.y;
}

void sincosf(float x, float* sine, float* cosine) noexcept {
  const Sleef_float_2 both = Sleef_cinz_sincosf1_u10purec(x);
  *sine = both.x;
  *cosine = both.y;
}

ESPALIER_UNARY(sinh, u10)
ESPALIER_UNARY(cosh, u10)
ESPALIER_UNARY(tanh, u10)

ESPALIER_UNARY(erf, u10)
ESPALIER_UNARY(erfc, u15)

}  // extern "C"

namespace espalier {

std::string sleef_version() {
  return fmt::format("{}.{}.{}", SLEEF_VERSION_MAJOR, SLEEF_VERSION_MINOR, SLEEF_VERSION_PATCHLEVEL);
}

}  // namespace espalier
