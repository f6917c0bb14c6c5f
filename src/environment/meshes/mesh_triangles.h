// The triangles of mesh files, read by Assimp: in a child without rights (machine/child.h), since damaged
// files crash it, and from bytes in memory: files from strangers, which may name others, open none.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include <espalier/core/vec3.h>

namespace espalier {

/// All triangles, three vertices each, of a mesh file of this format ("obj", "ply", "stl", "off", "glb",
/// "gltf"), its coordinates as they are. Throws InputError, which opens with the subject ("mesh 'a.ply'"),
/// for bytes that are no mesh, more than `most_triangles`, and no finite numbers; and where its reader
/// crashes, or needs more time or memory than a file of this size may.
std::vector<Vec3> read_mesh_triangles(std::string_view bytes, const std::string& format,
                                      const std::string& subject, std::size_t most_triangles);

}  // namespace espalier
