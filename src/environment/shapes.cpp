// The volumes with a formula: box, ball and cylinder. Metres, z up; surfaces belong to the inside.
// Distances are compared as squares, in double, so that the answer does not hang on float rounding.
#include <cmath>
#include <string_view>

#include "core/error.h"
#include "environment/volume.h"

namespace espalier {

namespace {

void check_finite(std::string_view shape, Vec3 position_m) {
  if (!std::isfinite(position_m.x) || !std::isfinite(position_m.y) || !std::isfinite(position_m.z))
    throw_input_error("{}: centre is {}, {}, {}, expected finite numbers in metres", shape, position_m.x,
                      position_m.y, position_m.z);
}

void check_size(std::string_view shape, std::string_view what, float size_m) {
  if (!std::isfinite(size_m) || size_m <= 0)
    throw_input_error("{}: {} is {}, expected a positive number of metres", shape, what, size_m);
}

double square(double x) { return x * x; }

class Box final : public Volume {
 public:
  Box(Vec3 center_m, Vec3 size_m) : center_m_(center_m), half_m_(size_m * 0.5f) {}
  bool contains(Vec3 p) const override {
    return std::fabs(p.x - center_m_.x) <= half_m_.x && std::fabs(p.y - center_m_.y) <= half_m_.y &&
           std::fabs(p.z - center_m_.z) <= half_m_.z;
  }

 private:
  Vec3 center_m_, half_m_;
};

class Ball final : public Volume {
 public:
  Ball(Vec3 center_m, float radius_m) : center_m_(center_m), radius_m_(radius_m) {}
  bool contains(Vec3 p) const override {
    const Vec3 d = p - center_m_;
    return square(d.x) + square(d.y) + square(d.z) <= square(radius_m_);
  }

 private:
  Vec3 center_m_;
  float radius_m_;
};

class Cylinder final : public Volume {
 public:
  Cylinder(Vec3 base_center_m, float radius_m, float height_m)
      : base_m_(base_center_m), radius_m_(radius_m), height_m_(height_m) {}
  bool contains(Vec3 p) const override {
    const Vec3 d = p - base_m_;
    return d.z >= 0 && d.z <= height_m_ && square(d.x) + square(d.y) <= square(radius_m_);
  }

 private:
  Vec3 base_m_;
  float radius_m_, height_m_;
};

}  // namespace

std::unique_ptr<Volume> make_box(Vec3 center_m, Vec3 size_m) {
  check_finite("box", center_m);
  check_size("box", "size in x", size_m.x);
  check_size("box", "size in y", size_m.y);
  check_size("box", "size in z", size_m.z);
  return std::make_unique<Box>(center_m, size_m);
}

std::unique_ptr<Volume> make_ball(Vec3 center_m, float radius_m) {
  check_finite("ball", center_m);
  check_size("ball", "radius", radius_m);
  return std::make_unique<Ball>(center_m, radius_m);
}

std::unique_ptr<Volume> make_cylinder(Vec3 base_center_m, float radius_m, float height_m) {
  check_finite("cylinder", base_center_m);
  check_size("cylinder", "radius", radius_m);
  check_size("cylinder", "height", height_m);
  return std::make_unique<Cylinder>(base_center_m, radius_m, height_m);
}

}  // namespace espalier
