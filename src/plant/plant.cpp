// Emptying a plant and its bounding box. Metres.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>

#include <espalier/plant/leaf_outlines.h>
#include <espalier/plant/plant.h>

namespace espalier {

namespace {

constexpr int kSamplesPerSegment = 8;

void include(Bounds& box, Vec3 lower, Vec3 upper) {
  box.lower = {std::min(box.lower.x, lower.x), std::min(box.lower.y, lower.y),
               std::min(box.lower.z, lower.z)};
  box.upper = {std::max(box.upper.x, upper.x), std::max(box.upper.y, upper.y),
               std::max(box.upper.z, upper.z)};
}

/// Rounding moves a point of a curve out of the box of its control points by less than this share.
constexpr float kRounding = 1e-5f;

/// Whether nothing within `reach` of the box from lower to upper can widen `box`.
bool holds(const Bounds& box, Vec3 lower, Vec3 upper, Vec3 reach) {
  const auto within = [](float least, float low, float high, float most, float by) {
    const float margin = by + kRounding * (std::fabs(low) + std::fabs(high) + by);
    return least <= low - margin && high + margin <= most;
  };
  return within(box.lower.x, lower.x, upper.x, box.upper.x, reach.x) &&
         within(box.lower.y, lower.y, upper.y, box.upper.y, reach.y) &&
         within(box.lower.z, lower.z, upper.z, box.upper.z, reach.z);
}

/// A curve lies within the box of its control points: most segments need no closer look.
bool holds_segment(const Bounds& box, const Knots& knots, std::size_t k) {
  Bounds hull{knots.point_m[k], knots.point_m[k]};
  for (const Vec3 p : {knots.handle_out_m[k], knots.handle_in_m[k + 1], knots.point_m[k + 1]})
    include(hull, p, p);
  const float radius = std::max(std::fabs(knots.radius_m[k]), std::fabs(knots.radius_m[k + 1]));
  return holds(box, hull.lower, hull.upper, {radius, radius, radius});
}

/// Half the width along one axis of a unit disc whose normal has this component there.
float disc_extent(float normal_component) {
  return std::sqrt(std::max(0.0f, 1 - normal_component * normal_component));
}

void include_disc(Bounds& box, Vec3 center, Vec3 normal, float radius) {
  const Vec3 extent = Vec3{disc_extent(normal.x), disc_extent(normal.y), disc_extent(normal.z)} * radius;
  include(box, center - extent, center + extent);
}

/// The segment between knots k and k + 1 as discs across the curve.
void include_segment(Bounds& box, const Knots& knots, std::size_t k) {
  if (holds_segment(box, knots, k)) return;
  const Vec3 p0 = knots.point_m[k], p1 = knots.handle_out_m[k];
  const Vec3 p2 = knots.handle_in_m[k + 1], p3 = knots.point_m[k + 1];
  const Vec3 chord = normalized(p3 - p0);
  for (int i = 0; i <= kSamplesPerSegment; ++i) {
    const float t = static_cast<float>(i) / kSamplesPerSegment, s = 1 - t;
    const Vec3 center = s * s * s * p0 + 3 * s * s * t * p1 + 3 * s * t * t * p2 + t * t * t * p3;
    const Vec3 tangent = s * s * (p1 - p0) + 2 * s * t * (p2 - p1) + t * t * (p3 - p2);
    include_disc(box, center, normalized(tangent, chord), s * knots.radius_m[k] + t * knots.radius_m[k + 1]);
  }
}

void include_stems(Bounds& box, const Plant& plant) {
  for (std::size_t stem = 0; stem < plant.stems.size(); ++stem)
    for (std::size_t k = plant.stems.first_knot[stem]; k + 1 < plant.stems.first_knot[stem + 1]; ++k)
      include_segment(box, plant.knots, k);
}

Vec3 absolute(Vec3 v) { return {std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}; }

/// An outline and how far it reaches along each of its axes.
struct ReachingOutline {
  explicit ReachingOutline(const LeafOutline& outline) : vertices(outline.vertices) {
    for (const Vec3 v : vertices)
      reach = {std::max(reach.x, std::fabs(v.x)), std::max(reach.y, std::fabs(v.y)),
               std::max(reach.z, std::fabs(v.z))};
  }
  std::span<const Vec3> vertices;
  Vec3 reach{};
};

void include_leaf(Bounds& box, const Leaves& leaves, std::size_t i, const ReachingOutline& outline) {
  const Vec3 side = leaves.side[i] * leaves.width_m[i], axis = leaves.axis[i] * leaves.length_m[i];
  const Vec3 normal = cross(leaves.side[i], leaves.axis[i]) * leaves.length_m[i];
  const Vec3 stalk = leaves.position_m[i], reach = outline.reach;
  const Vec3 around = absolute(side) * reach.x + absolute(axis) * reach.y + absolute(normal) * reach.z;
  if (holds(box, stalk, stalk, around)) return;
  for (const Vec3 v : outline.vertices) {
    const Vec3 point = stalk + side * v.x + axis * v.y + normal * v.z;
    include(box, point, point);
  }
}

void include_leaves(Bounds& box, const Plant& plant) {
  std::optional<ReachingOutline> leaf, blossom;  // a shape that no part has need not be one
  for (std::size_t i = 0; i < plant.leaves.size(); ++i) {
    const bool is_leaf = plant.leaves.kind[i] == LeafKind::leaf;
    std::optional<ReachingOutline>& outline = is_leaf ? leaf : blossom;
    if (!outline)
      outline.emplace(is_leaf ? leaf_outline(plant.leaf_shape) : blossom_outline(plant.blossom_shape));
    include_leaf(box, plant.leaves, i, *outline);
  }
}

}  // namespace

void Plant::clear() {
  stems.first_knot.clear();
  stems.parent.clear();
  stems.level.clear();
  stems.path_key.clear();
  stems.origin.clear();
  stems.child_index.clear();
  knots.point_m.clear();
  knots.handle_in_m.clear();
  knots.handle_out_m.clear();
  knots.radius_m.clear();
  knots.color.clear();
  leaves.position_m.clear();
  leaves.axis.clear();
  leaves.side.clear();
  leaves.length_m.clear();
  leaves.width_m.clear();
  leaves.kind.clear();
  leaves.color.clear();
  leaves.shade.clear();
  leaf_shape = 8;
  blossom_shape = 1;
  tree_scale_m = 0;
}

std::size_t memory_bytes(const Plant& plant) {
  const auto bytes = [](const auto&... columns) {
    return (... + (columns.capacity() * sizeof(columns.front())));
  };
  const auto& [stems, knots, leaves, leaf_shape, blossom_shape, tree_scale_m] = plant;
  return bytes(stems.first_knot, stems.parent, stems.level, stems.path_key, stems.origin, stems.child_index,
               knots.point_m, knots.handle_in_m, knots.handle_out_m, knots.radius_m, leaves.position_m,
               leaves.axis, leaves.side, leaves.length_m, leaves.width_m, leaves.kind, knots.color,
               leaves.color, leaves.shade);
}

Bounds bounds(const Plant& plant) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Bounds box{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  include_stems(box, plant);
  include_leaves(box, plant);
  return box.lower.x <= box.upper.x ? box : Bounds{};
}

}  // namespace espalier
