// The fast renderer: everything is drawn by scan lines, in the pixels that the Embree reference sets.
// Leaves come first: they cover most of the stems and of each other, and what is covered costs little.
#include "render/embree_geometry.h"
#include "render/row_limits.h"
#include "render/scanline_leaves.h"
#include "render/scanline_stems.h"
#include "render/silhouette.h"

namespace espalier {

namespace {

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

class ScanlineRenderer final : public SilhouetteRenderer {
 public:
  void draw(const Plant& plant, const Camera& camera, Mask& mask) override {
    if (mask.width_px() != camera.width_px || mask.height_px() != camera.height_px)
      mask = Mask(camera.width_px, camera.height_px);
    else
      mask.clear();
    draw_leaves(plant, camera, mask);
    draw_blossoms(plant, camera, mask);
    draw_stems(plant, camera, mask);
  }

 private:
  void draw_blossoms(const Plant& plant, const Camera& camera, Mask& mask) {
    blossoms_.collect(plant);
    const auto corner = [&](std::uint32_t i) {
      const auto& v = blossoms_.vertices[i];
      return project(camera, {v[0], v[1], v[2]});
    };
    const bool has_eye = camera.projection == Projection::perspective;
    for (const auto& triangle : blossoms_.triangles) {
      const PicturePoint a = corner(triangle[0]), b = corner(triangle[1]), c = corner(triangle[2]);
      const bool is_behind_eye = has_eye && !(std::min({a.depth_m, b.depth_m, c.depth_m}) > 0);
      if (!is_behind_eye) draw_triangle(a, b, c, mask);
    }
  }

  BlossomTriangles blossoms_;
};

}  // namespace

std::unique_ptr<SilhouetteRenderer> make_scanline_renderer() { return std::make_unique<ScanlineRenderer>(); }

}  // namespace espalier
