// Sine and cosine of an angle in degrees, with our own polynomials (Cephes: Moshier 1992, sinf.c and cosf.c;
// errors below 3e-7): faster than the C library's, and the same bits whatever its version. The vector form
// is in vector_math-inl.h.
#pragma once
#include <cmath>

namespace espalier {

struct SineAndCosine {
  float sine, cosine;
};

inline SineAndCosine sine_cosine_deg(float angle_deg) {
  const float quarters = std::nearbyint(angle_deg * (1.0f / 90));
  const float x = (angle_deg - quarters * 90) * 0.017453292519943295f, z = x * x;
  const float s = ((8.3321608736e-3f - z * 1.9515295891e-4f) * z - 1.6666654611e-1f) * z * x + x;
  const float c = ((z * 2.443315711809948e-5f - 1.388731625493765e-3f) * z + 4.166664568298827e-2f) * z * z -
                  z * 0.5f + 1;
  switch (static_cast<int>(quarters) & 3) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

}  // namespace espalier
