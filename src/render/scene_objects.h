// What stands beside a plant in a picture, as triangles: a house, a wall. Metres, z up.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include <espalier/core/vec3.h>
#include <espalier/plant/plant.h>

namespace espalier {

struct SceneObjects {
  std::vector<Vec3> vertices_m;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices of vertices
};

/// The box around a plant and all that stands beside it.
Bounds bounds(const Plant& plant, const SceneObjects& objects);

}  // namespace espalier
