#include <fmt/format.h>
#include <sleef.h>

#include <cmath>

#include <espalier/libm/libm.h>
#include <espalier/libm/power.h>

// The signatures are those of the C library; compiled with -fno-builtin, so that no body becomes a call of
// itself. cinz: the forms that give the same bits with every instruction set.
//
// Of double precision, the function within 1.0 units in the last place. Of single precision, that of double
// precision within 3.5 units, rounded: half as slow as SLEEF's own, and right but for one result in millions.
#define ESPALIER_UNARY(NAME, ERROR, ERROR_OF_FLOAT)                                  \
  double NAME(double x) noexcept { return Sleef_cinz_##NAME##d1_##ERROR##purec(x); } \
  float NAME##f(float x) noexcept {                                                  \
    return static_cast<float>(Sleef_cinz_##NAME##d1_##ERROR_OF_FLOAT##purec(x));     \
  }

extern "C" {

ESPALIER_UNARY(exp, u10, u10)
ESPALIER_UNARY(exp2, u10, u35)
ESPALIER_UNARY(exp10, u10, u35)
ESPALIER_UNARY(expm1, u10, u10)
ESPALIER_UNARY(log, u10, u35)
ESPALIER_UNARY(log2, u10, u35)
ESPALIER_UNARY(log10, u10, u10)
ESPALIER_UNARY(log1p, u10, u10)
ESPALIER_UNARY(cbrt, u10, u35)

double pow(double x, double y) noexcept { return Sleef_cinz_powd1_u10purec(x, y); }
float powf(float x, float y) noexcept {
  return espalier::is_plain_power(x, y) ? espalier::plain_power(x, y) : Sleef_cinz_powf1_u10purec(x, y);
}

double hypot(double x, double y) noexcept { return Sleef_cinz_hypotd1_u05purec(x, y); }
float hypotf(float x, float y) noexcept { return static_cast<float>(Sleef_cinz_hypotd1_u35purec(x, y)); }

ESPALIER_UNARY(sin, u10, u35)
ESPALIER_UNARY(cos, u10, u35)
ESPALIER_UNARY(tan, u10, u35)
ESPALIER_UNARY(asin, u10, u35)
ESPALIER_UNARY(acos, u10, u35)
ESPALIER_UNARY(atan, u10, u35)

double atan2(double y, double x) noexcept { return Sleef_cinz_atan2d1_u10purec(y, x); }
float atan2f(float y, float x) noexcept { return static_cast<float>(Sleef_cinz_atan2d1_u35purec(y, x)); }

// Compilers make one call of a sine and a cosine of the same angle.
void sincos(double x, double* sine, double* cosine) noexcept {
  const Sleef_double_2 both = Sleef_cinz_sincosd1_u10purec(x);
  *sine = both.x;
  *cosine = both.y;
}

void sincosf(float x, float* sine, float* cosine) noexcept {
  const Sleef_double_2 both = Sleef_cinz_sincosd1_u35purec(x);
  *sine = static_cast<float>(both.x);
  *cosine = static_cast<float>(both.y);
}

ESPALIER_UNARY(sinh, u10, u35)
ESPALIER_UNARY(cosh, u10, u35)
ESPALIER_UNARY(tanh, u10, u35)

ESPALIER_UNARY(erf, u10, u10)
ESPALIER_UNARY(erfc, u15, u15)

}  // extern "C"

namespace espalier {

std::string sleef_version() {
  return fmt::format("{}.{}.{}", SLEEF_VERSION_MAJOR, SLEEF_VERSION_MINOR, SLEEF_VERSION_PATCHLEVEL);
}

}  // namespace espalier
