#include <algorithm>
#include <cmath>

#include <espalier/lsystem/surfaces/triangle_leaves.h>
#include <espalier/plant/leaf_outlines.h>

namespace espalier::lsystem {

namespace {

constexpr int kTriangularShape = 10;

/// Half the width of the triangular outline, whose base runs through the stalk and whose tip is at y = 1.
float half_base() {
  float half = 0;
  for (const Vec3 vertex : leaf_outline(kTriangularShape).vertices) half = std::max(half, vertex.x);
  return half;
}

void add_triangle(const ColoredTriangle& colored, float half_base, Leaves& leaves,
                  std::vector<std::uint32_t>& organs) {
  const auto& [triangle, color, organ, is_plain] = colored;
  const Vec3 foot = (triangle[0] + triangle[1]) * 0.5f;
  const Vec3 side = triangle[1] - foot, axis = triangle[2] - foot;
  if (!(length(cross(side, axis)) > 0)) return;
  leaves.position_m.push_back(foot);
  leaves.axis.push_back(normalized(axis));
  leaves.side.push_back(normalized(side));
  leaves.length_m.push_back(length(axis));
  leaves.width_m.push_back(length(side) / half_base);
  leaves.kind.push_back(LeafKind::leaf);
  leaves.color.push_back(color);
  leaves.shade.push_back(is_plain ? kPlainShade : organ);
  organs.push_back(organ);
}

PartColor color_of(const Leaves& leaves, std::size_t i) {
  return i < leaves.color.size() ? leaves.color[i] : PartColor{};
}

void copy_leaf(const Leaves& from, std::size_t i, Leaves& to) {
  to.position_m.push_back(from.position_m[i]);
  to.axis.push_back(from.axis[i]);
  to.side.push_back(from.side[i]);
  to.length_m.push_back(from.length_m[i]);
  to.width_m.push_back(from.width_m[i]);
  to.kind.push_back(from.kind[i]);
  to.color.push_back(color_of(from, i));
}

}  // namespace

void draw_as_triangles(const std::vector<ColoredTriangle>& triangles, Plant& plant,
                       std::vector<std::uint32_t>& organ_of_leaf) {
  const float half = half_base();
  const LeafOutline& outline = leaf_outline(plant.leaf_shape);
  const Leaves& old = plant.leaves;
  Leaves leaves;
  std::vector<std::uint32_t> organs;
  for (std::size_t i = 0; i < old.size(); ++i) {
    if (old.kind[i] == LeafKind::blossom) {
      copy_leaf(old, i, leaves);
      leaves.shade.push_back(organ_of_leaf[i]);
      organs.push_back(organ_of_leaf[i]);
      continue;
    }
    const auto place = [&](const Vec3& v) {
      return old.position_m[i] + old.side[i] * (v.x * old.width_m[i]) + old.axis[i] * (v.y * old.length_m[i]);
    };
    const bool is_plain = i < old.shade.size() && old.shade[i] == kPlainShade;
    for (const auto& [a, b, c] : outline.triangles)
      add_triangle({{place(outline.vertices[a]), place(outline.vertices[b]), place(outline.vertices[c])},
                    color_of(old, i),
                    organ_of_leaf[i],
                    is_plain},
                   half, leaves, organs);
  }
  for (const ColoredTriangle& triangle : triangles) add_triangle(triangle, half, leaves, organs);
  const bool has_colors =
      std::any_of(leaves.color.begin(), leaves.color.end(), [](PartColor c) { return c.is_set; });
  if (!has_colors) leaves.color.clear();
  plant.leaves = std::move(leaves);
  organ_of_leaf = std::move(organs);
  plant.leaf_shape = kTriangularShape;
}

}  // namespace espalier::lsystem
