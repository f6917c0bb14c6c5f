// Blossoms as triangles in the world. Metres.
#include <cmath>

#include <espalier/plant/leaf_outlines.h>
#include <espalier/render/embree/embree_geometry.h>

namespace espalier {

namespace {

constexpr float kSmallestBlossomM = 1e-7f;
constexpr float kLargestCoordinateM = 1e9f;

bool is_usable(Vec3 p) {
  return std::fabs(p.x) < kLargestCoordinateM && std::fabs(p.y) < kLargestCoordinateM &&
         std::fabs(p.z) < kLargestCoordinateM;
}

void collect_blossom(BlossomTriangles& blossoms, const Plant& plant, std::size_t i) {
  const Leaves& leaves = plant.leaves;
  const LeafOutline& outline = blossom_outline(plant.blossom_shape);
  const float length_m = leaves.length_m[i], width_m = leaves.width_m[i];
  if (!(length_m > kSmallestBlossomM) || !(width_m > kSmallestBlossomM)) return;
  const Vec3 side = leaves.side[i] * width_m, axis = leaves.axis[i] * length_m;
  const Vec3 normal = cross(leaves.side[i], leaves.axis[i]) * length_m;
  if (!is_usable(leaves.position_m[i]) || !is_usable(side) || !is_usable(axis) || !is_usable(normal)) return;
  const auto first = static_cast<std::uint32_t>(blossoms.vertices.size());
  for (const Vec3 v : outline.vertices) {
    const Vec3 p = leaves.position_m[i] + side * v.x + axis * v.y + normal * v.z;
    blossoms.vertices.push_back({p.x, p.y, p.z, 0});
  }
  for (const auto& [a, b, c] : outline.triangles) {
    blossoms.triangles.push_back({first + a, first + b, first + c});
    blossoms.leaf.push_back(static_cast<std::uint32_t>(i));
  }
}

}  // namespace

void BlossomTriangles::collect(const Plant& plant) {
  vertices.clear();
  triangles.clear();
  leaf.clear();
  for (std::size_t i = 0; i < plant.leaves.size(); ++i)
    if (plant.leaves.kind[i] == LeafKind::blossom) collect_blossom(*this, plant, i);
}

}  // namespace espalier
