// The turtle that reads strings: position, heading H, left L and up U = H × L [Herbaceous §3, Topiary Fig.
// 1], in units of the file and double precision. It starts at the origin, heading up (+z), its left to -x:
// the plane of the front view, so that 2-D systems are drawn as printed. Angles in degrees.
#pragma once
#include <array>
#include <cmath>
#include <numbers>

#include <espalier/plant/plant.h>

namespace espalier::lsystem {

struct Vector {
  double x = 0, y = 0, z = 0;
};

inline Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vector operator*(Vector a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector cross(Vector a, Vector b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vector a) { return std::sqrt(dot(a, a)); }

/// Sine and cosine of the last angle, because most turns repeat it; quarter turns are exact.
class Rotation {
 public:
  void set(double angle_deg) {
    if (angle_deg == angle_deg_) return;
    angle_deg_ = angle_deg;
    const double quarters = angle_deg / 90;
    if (quarters == std::floor(quarters) && std::fabs(quarters) < 1e9) {
      constexpr std::array<double, 4> kSines{0, 1, 0, -1};
      const auto turn = static_cast<std::size_t>(static_cast<long long>(quarters) & 3);
      sine = kSines[turn];
      cosine = kSines[(turn + 1) & 3];
      return;
    }
    const double angle_rad = angle_deg * std::numbers::pi / 180;
    sine = std::sin(angle_rad);
    cosine = std::cos(angle_rad);
  }

  double sine = 0, cosine = 1;

 private:
  double angle_deg_ = 0;
};

struct Turtle {
  Vector position;
  Vector heading{0, 0, 1}, left{-1, 0, 0}, up{0, -1, 0};
  double width = 0.1;   ///< diameter of segments
  int color_index = 0;  ///< in the table of colours; 0: that of the material
  PartColor color;

  /// Turns `a` towards `b`, and `b` away from `a`.
  static void turn(Vector& a, Vector& b, const Rotation& by) {
    const Vector from = a;
    a = a * by.cosine + b * by.sine;
    b = b * by.cosine - from * by.sine;
  }
  void turn_left(const Rotation& by) { turn(heading, left, by); }
  void pitch_up(const Rotation& by) { turn(heading, up, by); }
  void roll_left(const Rotation& by) { turn(left, up, by); }
  void move(double distance) { position = position + heading * distance; }

  /// $: rolls until the left vector is horizontal [ABOP §2.2: L = V × H / |V × H|].
  void level();
  /// @(x, y, z): heads for a point; left and up follow by the smallest turn.
  void look_at(Vector target);
  /// Tropism [Herbaceous §3]: turns by the angle e·|H × T| (radians) about H × T.
  void bend(Vector tropism, double susceptibility);
  /// Turns the whole frame about a vector by its length in radians.
  void rotate(Vector axis_rad);
};

}  // namespace espalier::lsystem
