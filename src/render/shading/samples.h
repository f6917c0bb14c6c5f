// Points that fill the unit square evenly: the same for every run, different for every pixel. No unit.
// The sequence is Roberts' R2 (Roberts 2018, "The unreasonable effectiveness of quasirandom sequences"),
// shifted by a hash of pixel and purpose (Cranley and Patterson 1976).
#pragma once
#include <cmath>
#include <cstdint>
#include <numbers>

#include <espalier/core/random.h>
#include <espalier/core/vec3.h>

namespace espalier {

struct UnitSquarePoint {
  float u = 0, v = 0;  ///< both in [0, 1)
};

/// Point `index` of the sequence of this pixel for this purpose.
inline UnitSquarePoint sample_point(RandomKey pixel, std::uint32_t purpose, int index) {
  constexpr double kPlastic = 1.32471795724474602596;  // the root of x³ = x + 1
  const double u = uniform_unit(pixel, purpose, 0) + index / kPlastic;
  const double v = uniform_unit(pixel, purpose, 1) + index / (kPlastic * kPlastic);
  return {static_cast<float>(u - std::floor(u)) * 0.999999f,
          static_cast<float>(v - std::floor(v)) * 0.999999f};
}

/// A direction around the unit vector `normal`, with density proportional to the cosine (Malley's method).
inline Vec3 cosine_direction(Vec3 normal, UnitSquarePoint p) {
  const float angle = 2 * std::numbers::pi_v<float> * p.u, radius = std::sqrt(p.v);
  const Vec3 across = any_perpendicular(normal), other = cross(normal, across);
  return normalized(
      across * (radius * std::cos(angle)) + other * (radius * std::sin(angle)) + normal * std::sqrt(1 - p.v),
      normal);
}

/// A direction inside the cone around the unit vector `axis`, uniform on the disc it spans.
inline Vec3 cone_direction(Vec3 axis, float half_angle_tangent, UnitSquarePoint p) {
  const float angle = 2 * std::numbers::pi_v<float> * p.u, radius = half_angle_tangent * std::sqrt(p.v);
  const Vec3 across = any_perpendicular(axis), other = cross(axis, across);
  return normalized(axis + across * (radius * std::cos(angle)) + other * (radius * std::sin(angle)), axis);
}

}  // namespace espalier
