// Plants as triangles: stems as closed tubes, leaves and blossoms as their outlines, one mesh a material.
// Metres, z up; triangles are counter-clockwise seen from outside (a leaf: from its upper side), normals
// are unit vectors. Leaves and blossoms have one layer of triangles, meant to be drawn from both sides.
// Level of detail is a length, how far tubes may lie from the true surface; leaves below detail 0.25 are
// kites.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <espalier/core/vec3.h>
#include <espalier/plant/plant.h>

namespace espalier {

struct TextureCoordinate {
  float u = 0, v = 0;
};

struct TriangleMesh {
  std::vector<Vec3> position_m, normal;  ///< a vertex each
  std::vector<TextureCoordinate> texture;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<PartColor> color;  ///< of each triangle; empty: none is set
};

struct PlantMesh {
  TriangleMesh bark, leaves, blossoms;

  std::size_t triangle_count() const {
    return bark.triangles.size() + leaves.triangles.size() + blossoms.triangles.size();
  }
  std::size_t vertex_count() const {
    return bark.position_m.size() + leaves.position_m.size() + blossoms.position_m.size();
  }
};

struct MeshOptions {
  float detail = 0.5f;  ///< 0 (low) to 1 (high); see mesh_tolerance_m
};

/// How far tubes may lie from stems of a plant of this size (the largest side of its bounds): 1/200 of it
/// at detail 0, a tenth of that at 0.5 and a hundredth at 1.
float mesh_tolerance_m(float plant_size_m, float detail);

/// How many sides a tube needs so that its flats lie within the tolerance of the circle: 3 to 64.
int tube_sides(float radius_m, float tolerance_m);

/// Bark: u once around, v along the stem in units of its largest circumference. Leaves: u across and v
/// along, both 0..1 over the outline's bounding box.
PlantMesh mesh_plant(const Plant& plant, const MeshOptions& options);

}  // namespace espalier
