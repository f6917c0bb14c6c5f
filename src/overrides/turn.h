// A rotation of space as the images of its axes.
#pragma once
#include <espalier/core/sine_cosine.h>
#include <espalier/core/vec3.h>

namespace espalier {

struct Turn {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

  Vec3 operator()(Vec3 v) const { return x * v.x + y * v.y + z * v.z; }
};

/// First `second`, then `first`, as matrices multiply.
inline Turn operator*(const Turn& first, const Turn& second) {
  return {first(second.x), first(second.y), first(second.z)};
}

/// About a unit vector, right-handed (Rodrigues' formula).
inline Turn turn_about(Vec3 axis, float angle_deg) {
  const auto [sine, cosine] = sine_cosine_deg(angle_deg);
  const auto turned = [axis, sine = sine, cosine = cosine](Vec3 v) {
    return v * cosine + cross(axis, v) * sine + axis * (dot(axis, v) * (1 - cosine));
  };
  return {turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1})};
}

/// The degrees by which `from` has to turn about the unit vector `axis` to lie above `to`: -180 to 180.
inline float angle_about_deg(Vec3 axis, Vec3 from, Vec3 to) {
  const Vec3 a = from - axis * dot(axis, from), b = to - axis * dot(axis, to);
  return std::atan2(dot(axis, cross(a, b)), dot(a, b)) * 57.29577951f;
}

/// The axis about which the unit vector `from` turns towards `to`; any at a right angle where they are
/// parallel.
inline Vec3 axis_between(Vec3 from, Vec3 to) {
  const Vec3 axis = cross(from, to);
  return length(axis) > 1e-4f ? normalized(axis) : any_perpendicular(from);
}

/// The shortest turn that takes one unit vector to another.
inline Turn turn_between(Vec3 from, Vec3 to) {
  const Vec3 axis = axis_between(from, to);
  return turn_about(axis, angle_about_deg(axis, from, to));
}

}  // namespace espalier
