// The volumes with a formula: box, ball, cylinder, ellipsoid and line. Metres, z up; surfaces belong to the
// inside. Distances are compared as squares, in double, so that the answer does not hang on float rounding.
#include <algorithm>
#include <cmath>
#include <string_view>

#include <espalier/core/error.h>
#include <espalier/environment/volume.h>

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
  float signed_distance_m(Vec3 p) const override {
    const Vec3 d = {std::fabs(p.x - center_m_.x) - half_m_.x, std::fabs(p.y - center_m_.y) - half_m_.y,
                    std::fabs(p.z - center_m_.z) - half_m_.z};
    return length({std::max(d.x, 0.f), std::max(d.y, 0.f), std::max(d.z, 0.f)}) +
           std::min(std::max({d.x, d.y, d.z}), 0.f);
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
  float signed_distance_m(Vec3 p) const override { return length(p - center_m_) - radius_m_; }

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
  float signed_distance_m(Vec3 p) const override {
    const Vec3 d = p - base_m_;
    const float side = std::hypot(d.x, d.y) - radius_m_, end = std::fabs(d.z - height_m_ / 2) - height_m_ / 2;
    return std::hypot(std::max(side, 0.f), std::max(end, 0.f)) + std::min(std::max(side, end), 0.f);
  }

 private:
  Vec3 base_m_;
  float radius_m_, height_m_;
};

class Ellipsoid final : public Volume {
 public:
  Ellipsoid(Vec3 center_m, Vec3 radius_m) : center_m_(center_m), radius_m_(radius_m) {}
  bool contains(Vec3 p) const override { return signed_distance_m(p) <= 0; }
  /// The distance to first order: f/|∇f| of f = |p/r| − 1.
  float signed_distance_m(Vec3 p) const override {
    const Vec3 d = p - center_m_;
    const Vec3 unit{d.x / radius_m_.x, d.y / radius_m_.y, d.z / radius_m_.z};
    const float share = length(unit);
    const float slope = length({unit.x / radius_m_.x, unit.y / radius_m_.y, unit.z / radius_m_.z});
    const float smallest_m = std::min({radius_m_.x, radius_m_.y, radius_m_.z});
    return slope > 0 ? std::max(share * (share - 1) / slope, -smallest_m) : -smallest_m;
  }

 private:
  Vec3 center_m_, radius_m_;
};

class Line final : public Volume {
 public:
  Line(Vec3 from_m, Vec3 to_m, float from_radius_m, float to_radius_m)
      : from_m_(from_m), along_m_(to_m - from_m), from_radius_m_(from_radius_m), to_radius_m_(to_radius_m) {}
  bool contains(Vec3 p) const override { return signed_distance_m(p) <= 0; }
  float signed_distance_m(Vec3 p) const override {
    const float square_m2 = dot(along_m_, along_m_);
    const float share = square_m2 > 0 ? std::clamp(dot(p - from_m_, along_m_) / square_m2, 0.f, 1.f) : 0.f;
    return length(p - from_m_ - along_m_ * share) - std::lerp(from_radius_m_, to_radius_m_, share);
  }

 private:
  Vec3 from_m_, along_m_;
  float from_radius_m_, to_radius_m_;
};

}  // namespace

std::unique_ptr<Volume> make_ellipsoid(Vec3 center_m, Vec3 radius_m) {
  check_finite("ellipsoid", center_m);
  check_size("ellipsoid", "radius in x", radius_m.x);
  check_size("ellipsoid", "radius in y", radius_m.y);
  check_size("ellipsoid", "radius in z", radius_m.z);
  return std::make_unique<Ellipsoid>(center_m, radius_m);
}

std::unique_ptr<Volume> make_line(Vec3 from_m, Vec3 to_m, float from_radius_m, float to_radius_m) {
  check_finite("line", from_m);
  check_finite("line", to_m);
  check_size("line", "first radius", from_radius_m);
  check_size("line", "last radius", to_radius_m);
  return std::make_unique<Line>(from_m, to_m, from_radius_m, to_radius_m);
}

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
