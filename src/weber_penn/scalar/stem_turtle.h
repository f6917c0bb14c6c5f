// The moving frame that stems grow by, after the turtle of [CH §3.2.1]: a position, a heading and the
// vector to its right. Angles in degrees. `up` = right × forward completes the frame.
#pragma once
#include <cmath>
#include <numbers>

#include <espalier/core/sine_cosine.h>
#include <espalier/core/vec3.h>

namespace espalier {

inline float radians(float angle_deg) { return angle_deg * (std::numbers::pi_v<float> / 180); }
inline float degrees(float angle_rad) { return angle_rad * (180 / std::numbers::pi_v<float>); }

/// `v` turned about the unit vector `axis` (Rodrigues' formula, right-handed).
inline Vec3 rotated(Vec3 v, Vec3 axis, SineAndCosine turn) {
  return v * turn.cosine + cross(axis, v) * turn.sine + axis * (dot(axis, v) * (1 - turn.cosine));
}

/// Angle of a direction from straight up, in degrees.
inline float declination_deg(Vec3 forward) {
  return degrees(std::acos(std::fmin(1.f, std::fmax(-1.f, forward.z))));
}

/// Turns do not round the frame back to unit length: whoever makes many calls renormalize().
struct StemTurtle {
  Vec3 position_m;
  Vec3 forward{0, 0, 1}, right{1, 0, 0};

  void move(float distance_m) { position_m += forward * distance_m; }

  /// Turns the heading to the right, about the frame's up axis.
  void turn_right(float angle_deg) {
    const auto [sine, cosine] = sine_cosine_deg(angle_deg);
    const Vec3 ahead = forward;
    forward = ahead * cosine + right * sine;
    right = right * cosine - ahead * sine;
  }
  void turn_left(float angle_deg) { turn_right(-angle_deg); }
  void pitch_down(float angle_deg) {
    const auto [sine, cosine] = sine_cosine_deg(angle_deg);
    forward = forward * cosine + cross(forward, right) * sine;
  }
  void roll_right(float angle_deg) {
    const auto [sine, cosine] = sine_cosine_deg(angle_deg);
    right = right * cosine + cross(forward, right) * sine;
  }

  /// Turns heading and right about a unit vector of the world.
  void rotate_about(Vec3 axis, float angle_deg) {
    const SineAndCosine turn = sine_cosine_deg(angle_deg);
    forward = rotated(forward, axis, turn);
    right = rotated(right, axis, turn);
  }

  /// Both vectors back to unit length, at a right angle.
  void renormalize() {
    forward = normalized(forward);
    right = normalized(right - forward * dot(forward, right), any_perpendicular(forward));
  }
};

}  // namespace espalier
