// Meshes whose triangles have colours of their own, cut into one mesh a colour: in files a colour is a
// material.
#pragma once
#include <map>

#include <espalier/plant/mesh.h>

namespace espalier {

/// A mesh has at most this many colours: more are rounded to fewer bits a channel, until they are no more
/// than that.
inline constexpr std::size_t kMostColors = 256;

/// Vertices that triangles of two colours share are doubled, and triangles keep their order. A mesh without
/// colours is one part, whose colour is not set.
std::map<PartColor, TriangleMesh> split_by_color(const TriangleMesh& mesh);

}  // namespace espalier
