// Meshes as surfaces of L-systems.
#pragma once
#include <string>
#include <vector>

#include <espalier/lsystem/surfaces/polygon.h>

namespace espalier::lsystem {

/// All triangles of a mesh file of this format ("obj", "ply", "stl", "off", "glb"), its coordinates as they
/// are. Throws InputError for bytes that are no mesh, for none or more than 100,000 triangles, or no finite
/// numbers.
std::vector<Triangle> read_surface_mesh(const std::string& bytes, const std::string& format,
                                        const std::string& label);

}  // namespace espalier::lsystem
