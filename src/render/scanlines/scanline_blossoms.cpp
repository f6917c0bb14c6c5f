// A blossom is tens of triangles, most of them on pixels that are set: its surroundings are looked at first.
#include <algorithm>
#include <array>
#include <cstring>

#include <espalier/core/error.h>
#include <espalier/plant/leaf_outlines.h>
#include <espalier/render/scanlines/row_limits.h>
#include <espalier/render/scanlines/scanline_blossoms.h>

namespace espalier {

namespace {

constexpr std::size_t kMostVertices = 256;

/// Adds the side of an edge on which `inside` lies.
void add_edge(RowLimits& limits, PicturePoint a, PicturePoint b, PicturePoint inside) {
  const float dx = b.x_px - a.x_px, dy = b.y_px - a.y_px;
  const float turn = dx * (inside.y_px - a.y_px) - dy * (inside.x_px - a.x_px);
  const float sign = turn < 0 ? -1.0f : 1.0f;
  limits.add(sign * dy, sign * (dy * a.x_px - dx * a.y_px), sign * dx);
}

void draw_triangle(PicturePoint a, PicturePoint b, PicturePoint c, Mask& mask) {
  const PixelRun rows = centres_between(std::min({a.y_px, b.y_px, c.y_px}),
                                        std::max({a.y_px, b.y_px, c.y_px}), mask.height_px());
  RowLimits limits;
  add_edge(limits, a, b, c);
  add_edge(limits, b, c, a);
  add_edge(limits, c, a, b);
  for (int row = rows.begin; row < rows.end; ++row) {
    const float y = static_cast<float>(row) + 0.5f;
    draw_run(mask, row, limits.low(y), limits.high(y));
  }
}

/// How far any vertex lies from the stalk.
float reach_of(const LeafOutline& outline) {
  float reach = 0;
  for (const Vec3 v : outline.vertices) reach = std::max(reach, length(v));
  return reach;
}

/// The pixels of the square around a ball, empty where it reaches behind a perspective camera's eye.
PixelRectangle box_around(const Camera& camera, Vec3 center_m, float radius_m, const Mask& mask) {
  const PicturePoint p = project(camera, center_m);
  float radius_px = radius_m / camera.metres_per_px;
  if (camera.projection == Projection::perspective) {
    if (!(p.depth_m > radius_m)) return {0, 0, 0, 0};
    radius_px *= 2 / (p.depth_m - radius_m);  // 2: also off the axis, where balls look larger
  }
  const PixelRun columns = centres_between(p.x_px - radius_px, p.x_px + radius_px, mask.width_px());
  const PixelRun rows = centres_between(p.y_px - radius_px, p.y_px + radius_px, mask.height_px());
  return {columns.begin, columns.end, rows.begin, rows.end};
}

void draw_blossom(const Leaves& leaves, std::size_t i, const LeafOutline& outline, const Camera& camera,
                  Mask& mask) {
  const Vec3 side = leaves.side[i] * leaves.width_m[i], axis = leaves.axis[i] * leaves.length_m[i];
  const Vec3 normal = cross(leaves.side[i], leaves.axis[i]) * leaves.length_m[i];
  std::array<PicturePoint, kMostVertices> corners;
  for (std::size_t v = 0; v < outline.vertices.size(); ++v) {
    const Vec3 at = outline.vertices[v];
    corners[v] = project(camera, leaves.position_m[i] + side * at.x + axis * at.y + normal * at.z);
  }
  for (const auto& [a, b, c] : outline.triangles) draw_triangle(corners[a], corners[b], corners[c], mask);
}

}  // namespace

void draw_blossoms(const Plant& plant, const Camera& camera, Mask& mask) {
  const LeafOutline& outline = blossom_outline(plant.blossom_shape);
  ESPALIER_CHECK_EQ(outline.vertices.size() <= kMostVertices, true);
  const Leaves& leaves = plant.leaves;
  if (leaves.size() == 0) return;
  if (std::memchr(leaves.kind.data(), static_cast<int>(LeafKind::blossom), leaves.size()) == nullptr) return;
  const float reach = reach_of(outline);
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    if (leaves.kind[i] != LeafKind::blossom) continue;
    const float radius_m = reach * std::max(leaves.length_m[i], leaves.width_m[i]);
    const PixelRectangle box = box_around(camera, leaves.position_m[i], radius_m, mask);
    if (!box.is_empty() && !is_covered(mask, box)) draw_blossom(leaves, i, outline, camera, mask);
  }
}

}  // namespace espalier
