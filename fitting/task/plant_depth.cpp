#include <algorithm>
#include <cmath>
#include <limits>

#include <espalier/fitting/task/plant_depth.h>

namespace espalier {

namespace {

/// From the least to the greatest of what was added.
struct Extent {
  float lower = std::numeric_limits<float>::max(), upper = std::numeric_limits<float>::lowest();

  void add(float value) {
    lower = std::min(lower, value);
    upper = std::max(upper, value);
  }
  double length() const { return std::max(0.0, static_cast<double>(upper) - static_cast<double>(lower)); }
};

}  // namespace

double depth_over_width(const Plant& plant, const Camera& camera) {
  const Vec3 across = camera.right, along{-across.y, across.x, 0};
  Extent width, depth;
  for (const Vec3 point : plant.knots.point_m) {
    width.add(dot(across, point));
    depth.add(dot(along, point));
  }
  return width.length() > 0 && depth.length() > 0 ? depth.length() / width.length() : 1;
}

double depth_excess(double depth_over_width) {
  constexpr double kUsual = 1.15;  // of 18 species and many seeds, 90 % lie within .86 and 1.10
  return std::max(0.0, std::fabs(std::log(depth_over_width)) - std::log(kUsual));
}

}  // namespace espalier
