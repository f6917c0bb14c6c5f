// Filled polygons of strings: { … } marks their vertices [ABOP §5.1]. They are flat, or nearly, and are cut
// into triangles by clipping ears (Meisters 1975) in the plane of their mean normal (Newell).
#pragma once
#include <array>
#include <span>
#include <vector>

#include <espalier/core/vec3.h>
#include <espalier/lsystem/strings/work.h>

namespace espalier::lsystem {

using Triangle = std::array<Vec3, 3>;

/// Appends the triangles of a polygon. One that crosses itself is filled as far as ears can be cut.
/// Which may take the cube of their number: it is counted as work.
void triangulate(std::span<const Vec3> vertices, std::vector<Triangle>& triangles, Work& work);

}  // namespace espalier::lsystem
