// From a plant to its meshes: tubes along flattened stems, outlines placed at leaves. Metres.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <espalier/plant/flatten.h>
#include <espalier/plant/leaf_outlines.h>
#include <espalier/plant/mesh.h>
#include <espalier/plant/tube.h>

namespace espalier {

namespace {

constexpr float kWholeLeavesFrom = 0.25f;  ///< level of detail

/// An outline with all that its copies share; normals and texture coordinates are those at unit size.
struct LeafTemplate {
  LeafOutline outline;
  std::vector<Vec3> normals;
  std::vector<TextureCoordinate> texture;
};

/// Each vertex's normal is the area-weighted mean of its triangles'.
std::vector<Vec3> smooth_normals(const LeafOutline& outline) {
  std::vector<Vec3> sums(outline.vertices.size());
  for (const auto& t : outline.triangles) {
    const Vec3 a = outline.vertices[t[0]], b = outline.vertices[t[1]], c = outline.vertices[t[2]];
    for (const std::uint32_t corner : t) sums[corner] += cross(b - a, c - a);
  }
  for (Vec3& sum : sums) sum = normalized(sum);
  return sums;
}

std::vector<TextureCoordinate> box_coordinates(const std::vector<Vec3>& vertices) {
  const auto [left, right] =
      std::minmax_element(vertices.begin(), vertices.end(), [](Vec3 a, Vec3 b) { return a.x < b.x; });
  const auto [foot, tip] =
      std::minmax_element(vertices.begin(), vertices.end(), [](Vec3 a, Vec3 b) { return a.y < b.y; });
  std::vector<TextureCoordinate> texture;
  texture.reserve(vertices.size());
  for (const Vec3 p : vertices)
    texture.push_back({(p.x - left->x) / (right->x - left->x), (p.y - foot->y) / (tip->y - foot->y)});
  return texture;
}

LeafTemplate make_template(const LeafOutline& outline) {
  return {outline, smooth_normals(outline), box_coordinates(outline.vertices)};
}

/// Two triangles between the stalk, the tip and the widest places; the outline itself where it is as simple.
LeafOutline kite(const LeafOutline& outline) {
  const auto& v = outline.vertices;
  const auto [left, right] =
      std::minmax_element(v.begin(), v.end(), [](Vec3 a, Vec3 b) { return a.x < b.x; });
  const auto [foot, tip] = std::minmax_element(v.begin(), v.end(), [](Vec3 a, Vec3 b) { return a.y < b.y; });
  if (v.size() <= 4) return outline;
  return {{*foot, *right, *tip, *left}, {{0, 1, 2}, {0, 2, 3}}};
}

LeafOutline leaf_at_detail(int shape, float detail) {
  return detail < kWholeLeavesFrom ? kite(leaf_outline(shape)) : leaf_outline(shape);
}

/// Scaled outlines need normals divided by the scale (the inverse transpose).
void append_leaf(const Leaves& leaves, std::size_t i, const LeafTemplate& leaf, TriangleMesh& mesh) {
  const float width_m = leaves.width_m[i], length_m = leaves.length_m[i];
  if (!(width_m > 0 && length_m > 0)) return;
  const Vec3 side = leaves.side[i], axis = leaves.axis[i], up = cross(side, axis);
  const auto first = static_cast<std::uint32_t>(mesh.position_m.size());
  for (std::size_t k = 0; k < leaf.outline.vertices.size(); ++k) {
    const Vec3 p = leaf.outline.vertices[k], n = leaf.normals[k];
    mesh.position_m.push_back(leaves.position_m[i] + side * (p.x * width_m) + axis * (p.y * length_m) +
                              up * (p.z * length_m));
    mesh.normal.push_back(normalized(side * (n.x * length_m) + (axis * n.y + up * n.z) * width_m, up));
    mesh.texture.push_back(leaf.texture[k]);
  }
  for (const auto& t : leaf.outline.triangles)
    mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  if (!leaves.color.empty()) mesh.color.resize(mesh.triangles.size(), leaves.color[i]);
}

void append_leaves(const Plant& plant, LeafKind kind, const LeafOutline& outline, TriangleMesh& mesh) {
  const LeafTemplate leaf = make_template(outline);
  const auto count =
      static_cast<std::size_t>(std::count(plant.leaves.kind.begin(), plant.leaves.kind.end(), kind));
  mesh.position_m.reserve(count * outline.vertices.size());
  mesh.normal.reserve(count * outline.vertices.size());
  mesh.texture.reserve(count * outline.vertices.size());
  mesh.triangles.reserve(count * outline.triangles.size());
  for (std::size_t i = 0; i < plant.leaves.size(); ++i)
    if (plant.leaves.kind[i] == kind) append_leaf(plant.leaves, i, leaf, mesh);
}

void append_stems(const Plant& plant, float tolerance_m, TriangleMesh& mesh) {
  Polyline line;
  for (std::size_t stem = 0; stem < plant.stems.size(); ++stem) {
    flatten_stem(plant, stem, tolerance_m, line);
    if (line.size() < 2) continue;
    const float thickest_m = *std::max_element(line.radius_m.begin(), line.radius_m.end());
    append_tube(line, tube_sides(thickest_m, tolerance_m), mesh);
  }
}

float largest_side_m(const Bounds& box) {
  const Vec3 size = box.upper - box.lower;
  return std::max({size.x, size.y, size.z});
}

}  // namespace

float mesh_tolerance_m(float plant_size_m, float detail) {
  return plant_size_m / 200 * std::pow(10.0f, -2 * detail);
}

int tube_sides(float radius_m, float tolerance_m) {
  // A chord of a circle lies r (1 - cos(π/n)) inside it.
  const float cosine = 1 - tolerance_m / std::max(radius_m, tolerance_m);
  const float sides = std::numbers::pi_v<float> / std::acos(cosine);
  return static_cast<int>(std::ceil(std::clamp(sides, 3.0f, 64.0f)));
}

PlantMesh mesh_plant(const Plant& plant, const MeshOptions& options) {
  PlantMesh mesh;
  append_stems(plant, mesh_tolerance_m(largest_side_m(bounds(plant)), options.detail), mesh.bark);
  append_leaves(plant, LeafKind::leaf, leaf_at_detail(plant.leaf_shape, options.detail), mesh.leaves);
  append_leaves(plant, LeafKind::blossom, blossom_outline(plant.blossom_shape), mesh.blossoms);
  return mesh;
}

}  // namespace espalier
