// Closed triangle meshes read from files: the surface of a volume. Metres, z up.
// Vertices at the same place are one vertex, whatever normals or texture coordinates the file gives
// them; then closed means that an even number of triangles meet at every edge.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include <espalier/core/vec3.h>

namespace espalier {

struct ClosedMesh {
  std::vector<Vec3> vertices_m;  ///< all different
  std::vector<std::array<std::uint32_t, 3>> triangles;
  bool oriented = true;  ///< at every edge as many triangles run along it as run back
};

/// Reads obj, ply, stl, off, glb or gltf, told apart by extension; all meshes of the file together. Files
/// that it names (of materials, of a gltf's numbers) are not opened.
/// Throws InputError for a file that is missing, unreadable, without triangles, flat, or open (with the
/// number of open edges).
ClosedMesh read_closed_mesh(const std::filesystem::path& path);

}  // namespace espalier
