// Rays, projections and framing. Metres; directions are unit vectors; radians only next to trigonometry.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <espalier/render/camera.h>

namespace espalier {

namespace {

constexpr float kRadiansPerDegree = std::numbers::pi_v<float> / 180;
constexpr float kSmallestFrameM = 1e-6f;

/// Right, up and forward of a view; position and scale are left at their defaults.
Camera oriented(const View& view, int width_px, int height_px) {
  const float azimuth = view.azimuth_deg * kRadiansPerDegree;
  const float elevation = view.elevation_deg * kRadiansPerDegree;
  Camera camera;
  camera.projection = view.projection;
  camera.right = {std::cos(azimuth), std::sin(azimuth), 0};
  camera.forward = {-std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation),
                    -std::sin(elevation)};
  camera.up = cross(camera.right, camera.forward);
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.center_x_px = 0.5f * static_cast<float>(width_px);
  camera.center_y_px = 0.5f * static_cast<float>(height_px);
  return camera;
}

/// The corners of a box relative to its middle, along right, up and forward of the camera.
std::array<Vec3, 8> corners_in_camera(const Camera& camera, const Bounds& box) {
  const Vec3 half = (box.upper - box.lower) * 0.5f;
  std::array<Vec3, 8> corners;
  for (unsigned i = 0; i < 8; ++i) {
    const Vec3 corner{i & 1 ? half.x : -half.x, i & 2 ? half.y : -half.y, i & 4 ? half.z : -half.z};
    corners[i] = {dot(corner, camera.right), dot(corner, camera.up), dot(corner, camera.forward)};
  }
  return corners;
}

/// The corner's largest extents: half the box's width, height and depth as the camera sees it.
Vec3 half_extent(const std::array<Vec3, 8>& corners) {
  Vec3 half;
  for (const Vec3 c : corners) half = {std::max(half.x, c.x), std::max(half.y, c.y), std::max(half.z, c.z)};
  return half;
}

float half_field_tangent(const View& view) {
  return std::tan(0.5f * view.field_of_view_deg * kRadiansPerDegree);
}

void frame_orthographic(Camera& camera, Vec3 middle, const Bounds& box, float margin) {
  const Vec3 half = half_extent(corners_in_camera(camera, box));
  const float width_px = static_cast<float>(camera.width_px);
  const float height_px = static_cast<float>(camera.height_px);
  camera.metres_per_px = 2 * margin * std::max(half.x / width_px, half.y / height_px);
  if (!(camera.metres_per_px > kSmallestFrameM / height_px)) camera.metres_per_px = 1 / height_px;
  camera.position_m = middle - camera.forward * (2 * half.z + 1);
}

/// The eye goes back along the axis until every corner lies inside the frame divided by the margin.
void frame_perspective(Camera& camera, Vec3 middle, const Bounds& box, float half_tangent, float margin) {
  const float aspect = static_cast<float>(camera.width_px) / static_cast<float>(camera.height_px);
  float distance_m = 0, nearest_corner_m = 0;
  for (const Vec3 c : corners_in_camera(camera, box)) {
    nearest_corner_m = std::max(nearest_corner_m, -c.z);
    distance_m = std::max(distance_m, std::fabs(c.x) * margin / (half_tangent * aspect) - c.z);
    distance_m = std::max(distance_m, std::fabs(c.y) * margin / half_tangent - c.z);
  }
  // A box seen as a point: a frame one metre high at its nearest corner.
  if (!(distance_m > nearest_corner_m + kSmallestFrameM)) distance_m = nearest_corner_m + 0.5f / half_tangent;
  camera.metres_per_px = 2 * half_tangent / static_cast<float>(camera.height_px);
  camera.position_m = middle - camera.forward * distance_m;
}

}  // namespace

Ray camera_ray(const Camera& camera, float x_px, float y_px) {
  const Vec3 offset = camera.right * ((x_px - camera.center_x_px) * camera.metres_per_px) -
                      camera.up * ((y_px - camera.center_y_px) * camera.metres_per_px);
  if (camera.projection == Projection::orthographic) return {camera.position_m + offset, camera.forward};
  return {camera.position_m, normalized(camera.forward + offset, camera.forward)};
}

PicturePoint project(const Camera& camera, Vec3 point_m) {
  const Vec3 offset = point_m - camera.position_m;
  const float depth_m = dot(offset, camera.forward);
  const float size_m =
      camera.projection == Projection::orthographic ? camera.metres_per_px : camera.metres_per_px * depth_m;
  return {camera.center_x_px + dot(offset, camera.right) / size_m,
          camera.center_y_px - dot(offset, camera.up) / size_m, depth_m};
}

Camera frame_bounds(const Bounds& box, const View& view, int width_px, int height_px, float margin) {
  Camera camera = oriented(view, width_px, height_px);
  const Vec3 middle = lerp(box.lower, box.upper, 0.5f);
  if (view.projection == Projection::orthographic)
    frame_orthographic(camera, middle, box, margin);
  else
    frame_perspective(camera, middle, box, half_field_tangent(view), margin);
  return camera;
}

Camera frame_base(Vec3 base_m, const View& view, float metres_per_px, int width_px, int height_px,
                  float base_row_px) {
  Camera camera = oriented(view, width_px, height_px);
  const float frame_height_m = metres_per_px * static_cast<float>(height_px);
  if (view.projection == Projection::orthographic) {
    camera.metres_per_px = metres_per_px;
    camera.center_y_px = base_row_px;
    camera.position_m = base_m - camera.forward * (4 * frame_height_m);
    return camera;
  }
  const float distance_m = 0.5f * frame_height_m / half_field_tangent(view);
  const float base_below_axis_m = (base_row_px - camera.center_y_px) * metres_per_px;
  camera.metres_per_px = metres_per_px / distance_m;
  camera.position_m = base_m - camera.forward * distance_m + camera.up * base_below_axis_m;
  return camera;
}

}  // namespace espalier
