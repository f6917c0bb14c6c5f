// The rectangle around the projected corners of a box. Metres and pixels.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <espalier/render/pixel_rectangle.h>

namespace espalier {

namespace {

std::array<Vec3, 8> corners_of(const Bounds& box) {
  std::array<Vec3, 8> corners;
  for (unsigned i = 0; i < 8; ++i)
    corners[i] = {i & 1 ? box.upper.x : box.lower.x, i & 2 ? box.upper.y : box.lower.y,
                  i & 4 ? box.upper.z : box.lower.z};
  return corners;
}

/// The first pixel of [0, size] at or before `position`, one pixel of slack for rounding.
int first_pixel(float position, int size) {
  return static_cast<int>(std::clamp(std::floor(position) - 1, 0.0f, static_cast<float>(size)));
}

int last_pixel(float position, int size) {
  return static_cast<int>(std::clamp(std::ceil(position) + 1, 0.0f, static_cast<float>(size)));
}

}  // namespace

PixelRectangle covered_pixels(const Camera& camera, const Bounds& box) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr float kNearestM = 1e-3f;
  float low_x = kInfinity, low_y = kInfinity, high_x = -kInfinity, high_y = -kInfinity;
  for (const Vec3 corner : corners_of(box)) {
    const PicturePoint p = project(camera, corner);
    if (camera.projection == Projection::perspective && p.depth_m < kNearestM)
      return {0, camera.width_px, 0, camera.height_px};
    low_x = std::min(low_x, p.x_px);
    low_y = std::min(low_y, p.y_px);
    high_x = std::max(high_x, p.x_px);
    high_y = std::max(high_y, p.y_px);
  }
  return {first_pixel(low_x, camera.width_px), last_pixel(high_x, camera.width_px),
          first_pixel(low_y, camera.height_px), last_pixel(high_y, camera.height_px)};
}

Camera moved_before(const Camera& camera, const Bounds& box) {
  if (camera.projection == Projection::perspective) return camera;
  float nearest_m = std::numeric_limits<float>::infinity();
  for (const Vec3 corner : corners_of(box)) nearest_m = std::min(nearest_m, project(camera, corner).depth_m);
  Camera moved = camera;
  const float size_m = length(box.upper - box.lower);
  moved.position_m += camera.forward * (nearest_m - 0.01f * size_m - 0.01f);
  return moved;
}

}  // namespace espalier
