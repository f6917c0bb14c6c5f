// Plants made by hand and measures of meshes, shared by the tests of flattening, meshing and export.
#pragma once
#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include <espalier/plant/mesh.h>
#include <espalier/plant/plant.h>

namespace espalier {

inline void add_stem(Plant& plant, const std::vector<Vec3>& points, const std::vector<Vec3>& handles_in,
                     const std::vector<Vec3>& handles_out, const std::vector<float>& radii) {
  if (plant.stems.first_knot.empty()) plant.stems.first_knot.push_back(0);
  for (std::size_t k = 0; k < points.size(); ++k) {
    plant.knots.point_m.push_back(points[k]);
    plant.knots.handle_in_m.push_back(handles_in[k]);
    plant.knots.handle_out_m.push_back(handles_out[k]);
    plant.knots.radius_m.push_back(radii[k]);
  }
  plant.stems.first_knot.push_back(static_cast<std::uint32_t>(plant.knots.size()));
  plant.stems.parent.push_back(-1);
  plant.stems.level.push_back(0);
  plant.stems.path_key.push_back(plant.stems.size());
  plant.stems.origin.push_back(-1);
  plant.stems.child_index.push_back(0);
}

/// A straight stem with evenly spaced handles.
inline void add_straight_stem(Plant& plant, Vec3 from_m, Vec3 to_m, float radius_from_m, float radius_to_m) {
  const Vec3 third = (to_m - from_m) * (1 / 3.0f);
  add_stem(plant, {from_m, to_m}, {from_m - third, to_m - third}, {from_m + third, to_m + third},
           {radius_from_m, radius_to_m});
}

/// A stem of several knots that turns in all directions, its radius shrinking from 0.1 m to `tip_radius_m`.
inline void add_winding_stem(Plant& plant, int knots, float tip_radius_m) {
  std::vector<Vec3> points, in, out;
  std::vector<float> radii;
  for (int k = 0; k < knots; ++k) {
    const float a = 1.1f * static_cast<float>(k),
                share = static_cast<float>(k) / static_cast<float>(knots - 1);
    const Vec3 point{std::cos(a), std::sin(a), 0.5f * a},
        handle{-0.35f * std::sin(a), 0.35f * std::cos(a), 0.18f};
    points.push_back(point);
    in.push_back(point - handle);
    out.push_back(point + handle);
    radii.push_back(0.1f + (tip_radius_m - 0.1f) * share);
  }
  add_stem(plant, points, in, out, radii);
}

inline void add_leaf(Plant& plant, Vec3 position_m, Vec3 axis, Vec3 side, LeafKind kind = LeafKind::leaf) {
  plant.leaves.position_m.push_back(position_m);
  plant.leaves.axis.push_back(axis);
  plant.leaves.side.push_back(side);
  plant.leaves.length_m.push_back(0.2f);
  plant.leaves.width_m.push_back(0.1f);
  plant.leaves.kind.push_back(kind);
}

/// Two stems, three leaves and two blossoms.
inline Plant small_plant() {
  Plant plant;
  add_straight_stem(plant, {0, 0, 0}, {0.2f, 0.1f, 3}, 0.1f, 0.02f);
  add_winding_stem(plant, 5, 0);
  add_leaf(plant, {1, 0, 2}, {0, 1, 0}, {1, 0, 0});
  add_leaf(plant, {0, 1, 2}, {0, 0, 1}, {0, 1, 0});
  add_leaf(plant, {0, 0, 3}, {1, 0, 0}, {0, 0, 1});
  add_leaf(plant, {1, 1, 2}, {0, 0, 1}, {1, 0, 0}, LeafKind::blossom);
  add_leaf(plant, {1, 2, 2}, {0, 0, -1}, {1, 0, 0}, LeafKind::blossom);
  return plant;
}

using PositionKey = std::tuple<float, float, float>;
inline PositionKey position_key(Vec3 p) { return {p.x, p.y, p.z}; }

/// How many edges, by the position of their ends, are not run along once in each direction.
inline std::size_t unmatched_edges(const TriangleMesh& mesh) {
  std::map<std::pair<PositionKey, PositionKey>, int> forward;
  for (const auto& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      const auto a = position_key(mesh.position_m[t[i]]), b = position_key(mesh.position_m[t[(i + 1) % 3]]);
      ++forward[{a, b}];
    }
  std::size_t unmatched = 0;
  for (const auto& [edge, count] : forward) {
    const auto back = forward.find({edge.second, edge.first});
    unmatched += count != 1 || back == forward.end() || back->second != 1;
  }
  return unmatched;
}

inline double enclosed_volume_m3(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += dot(mesh.position_m[t[0]], cross(mesh.position_m[t[1]], mesh.position_m[t[2]]));
  return sum / 6;
}

inline double area_m2(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.position_m[t[0]];
    sum += 0.5 * length(cross(mesh.position_m[t[1]] - a, mesh.position_m[t[2]] - a));
  }
  return sum;
}

}  // namespace espalier
