// Meshes of plants as files, written by Assimp: glb (glTF 2.0), obj with its mtl, binary ply, binary stl.
// Metres. In files with y up (x, y, z) is written as (x, z, -y): the front is seen from +z. glTF demands it,
// and readers of obj expect it; ply and stl are z up, as plants are, unless told otherwise. Which it is
// stands in the header of obj, ply and stl. Materials "bark", "leaf" and "blossom" are separate in glb and
// obj; stl has none, and ply could only tell them by vertex colours, which Assimp 5.2 writes wrongly (assimp
// issue 3827). Leaves are double-sided in glb; the other formats cannot say so.
#pragma once
#include <filesystem>
#include <optional>

#include <espalier/plant/mesh.h>

namespace espalier {

/// Throws InputError unless the extension is .glb, .obj, .ply or .stl and the folder of `path` exists and can
/// be written: to be called before anything costly is done.
void check_mesh_path(const std::filesystem::path& path);

enum class UpAxis { y, z };

/// The axis that points upwards in a file of this format, unless told otherwise. Throws as check_mesh_path
/// does.
UpAxis usual_up_axis(const std::filesystem::path& path);

/// Throws FieldError in "up" for a glb with z up: to be called before anything costly is done.
void check_up_axis(const std::filesystem::path& path, UpAxis up);

struct MeshFileOptions {
  std::optional<UpAxis> up = {};            ///< none: the usual one of the format
  PartColor bark = {}, leaf = {};           ///< of the species; not set: the usual ones
  std::size_t most_triangles = 20'000'000;  ///< writing takes some 300 bytes of memory for each
};

/// Writes the mesh, each file whole or not at all. An obj's mtl lies beside it and has its name, with `_` for
/// what not all readers of obj take in a name: anything but letters, digits, `.`, `-` and `_`. Throws
/// InputError for a mesh without triangles or with too many, or a path that cannot be written, FieldError in
/// "up" for a glb with z up.
void write_mesh(const PlantMesh& mesh, const std::filesystem::path& path,
                const MeshFileOptions& options = {});

/// mesh_plant, then write_mesh.
void export_mesh(const Plant& plant, const std::filesystem::path& path, const MeshOptions& options);

}  // namespace espalier
