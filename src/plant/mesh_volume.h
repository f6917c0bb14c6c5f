// How much room closed surfaces that run into each other take: tubes overlap where a branch leaves its
// parent, so that the sum of their volumes counts these places twice, and the union does not.
#pragma once
#include <espalier/plant/mesh.h>

namespace espalier {

struct MeshVolume {
  double sum_m3 = 0;    ///< of all surfaces
  double union_m3 = 0;  ///< of the points that lie in one of them at least
  double column_m = 0;  ///< side of the columns that both are measured in
};

/// Both along vertical columns, whose crossings with the surfaces are counted up and down (winding numbers),
/// as fine as `crossings` of them allow. Surfaces are closed and face outwards, as those of bark are.
MeshVolume measure_volume(const TriangleMesh& mesh, std::size_t crossings = 8'000'000);

}  // namespace espalier
