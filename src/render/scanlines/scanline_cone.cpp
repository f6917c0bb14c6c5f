// The silhouette of a capped cone: the quadrilateral of its two sides, and at its ends discs seen as
// ellipses. Exact for cylinders; where the radius changes, off by the square of its slope.
#include <algorithm>
#include <cmath>

#include <espalier/render/scanlines/row_limits.h>
#include <espalier/render/scanlines/scanline_cone.h>

namespace espalier {

namespace {

constexpr float kShortestConePx = 1e-4f;

/// The axis has the unit direction (ux, uy) and this length.
void draw_sides(ConeEnd a, ConeEnd b, float ux, float uy, float axis_px, Mask& mask) {
  const float reach_a = a.radius * std::fabs(ux), reach_b = b.radius * std::fabs(ux);
  const PixelRun rows = centres_between(std::min(a.y - reach_a, b.y - reach_b),
                                        std::max(a.y + reach_a, b.y + reach_b), mask.height_px());
  if (rows.begin >= rows.end) return;
  const float slope = (b.radius - a.radius) / axis_px;
  RowLimits limits;                                         // with s along the axis and t across it:
  limits.add(-ux, 0, uy);                                   // 0 <= s
  limits.add(ux, axis_px, -uy);                             // s <= axis
  limits.add(-uy - slope * ux, a.radius, slope * uy - ux);  // t <= radius(s)
  limits.add(uy - slope * ux, a.radius, slope * uy + ux);   // -t <= radius(s)
  for (int row = rows.begin; row < rows.end; ++row) {
    const float y = static_cast<float>(row) + 0.5f - a.y;
    draw_run(mask, row, a.x + limits.low(y), a.x + limits.high(y));
  }
}

/// A disc of this radius seen so that it is `minor` (half) wide along (ux, uy).
void draw_ellipse(ConeEnd disc, float minor, float ux, float uy, Mask& mask) {
  const float per_minor = 1 / (minor * minor), per_major = 1 / (disc.radius * disc.radius);
  const float xx = ux * ux * per_minor + uy * uy * per_major, xy = ux * uy * (per_minor - per_major);
  const float reach = minor * disc.radius * std::sqrt(xx);
  const PixelRun rows = centres_between(disc.y - reach, disc.y + reach, mask.height_px());
  for (int row = rows.begin; row < rows.end; ++row) {
    const float y = static_cast<float>(row) + 0.5f - disc.y;
    const float half = std::sqrt(std::max(0.0f, xx - y * y * per_minor * per_major)) / xx;
    draw_run(mask, row, disc.x - xy * y / xx - half, disc.x - xy * y / xx + half);
  }
}

}  // namespace

void draw_cone(ConeEnd a, ConeEnd b, float tilt, Mask& mask) {
  const float dx = b.x - a.x, dy = b.y - a.y, axis_px = std::sqrt(dx * dx + dy * dy);
  if (axis_px > kShortestConePx) draw_sides(a, b, dx / axis_px, dy / axis_px, axis_px, mask);
  draw_cone_ends(a, b, tilt, mask);
}

void draw_cone_ends(ConeEnd a, ConeEnd b, float tilt, Mask& mask) {
  const float dx = b.x - a.x, dy = b.y - a.y, axis_px = std::sqrt(dx * dx + dy * dy);
  const bool has_axis = axis_px > kShortestConePx;
  const float ux = has_axis ? dx / axis_px : 1, uy = has_axis ? dy / axis_px : 0;
  for (const ConeEnd& end : {a, b})
    if (end.radius * tilt > kThinnestEllipsePx) draw_ellipse(end, end.radius * tilt, ux, uy, mask);
}

}  // namespace espalier
