// A polyline with radii as a closed tube of triangles: rings joined by quads, flat caps at both ends.
// Metres. Rings are turned as little as possible from one to the next (parallel transport).
// Source: Wang, Jüttler, Zheng, Liu, "Computation of Rotation Minimizing Frames" (2008), double reflection.
#pragma once
#include <espalier/plant/flatten.h>
#include <espalier/plant/mesh.h>

namespace espalier {

/// Appends the tube with this many sides (3 or more) to `mesh`; nothing for lines of fewer than two points.
/// A ring thinner than 10 micrometres is one point, without a cap. Vertices at the texture's seam and at the
/// caps are doubled, at exactly the same place: by position every edge joins two triangles.
void append_tube(const Polyline& line, int sides, TriangleMesh& mesh);

}  // namespace espalier
