// Meshes of plants as files, written by Assimp: glb (glTF 2.0), obj with its mtl, binary ply, binary stl.
// Metres. glTF demands y up: there (x, y, z) is written as (x, z, -y); the others are z up, as plants are.
// Materials "bark", "leaf" and "blossom" are separate in glb and obj; stl has none, and ply could only tell
// them by vertex colours, which Assimp 5.2 writes wrongly (assimp issue 3827). Leaves are double-sided in
// glb; the other formats cannot say so.
#pragma once
#include <filesystem>

#include <espalier/plant/mesh.h>

namespace espalier {

/// Throws InputError unless the extension is .glb, .obj, .ply or .stl and the folder of `path` exists and can
/// be written: to be called before anything costly is done.
void check_mesh_path(const std::filesystem::path& path);

/// Writes the mesh, each file whole or not at all. An obj's mtl has the same name beside it.
/// Throws InputError for a mesh without triangles or a path that cannot be written.
void write_mesh(const PlantMesh& mesh, const std::filesystem::path& path);

/// mesh_plant, then write_mesh.
void export_mesh(const Plant& plant, const std::filesystem::path& path, const MeshOptions& options);

}  // namespace espalier
