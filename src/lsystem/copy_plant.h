// Copies of a plant in another: what an L-system's `plant` statement grew, placed by the turtle.
#pragma once
#include <vector>

#include "lsystem/stem_splines.h"
#include "lsystem/triangle_leaves.h"
#include "plant/plant.h"

namespace espalier::lsystem {

/// Where a copy stands, and what the plant's axes become: metres of one unit along each.
struct CopyFrame {
  Vec3 origin_m, x_m, y_m, z_m;

  Vec3 direction_m(Vec3 v) const { return x_m * v.x + y_m * v.y + z_m * v.z; }
  Vec3 point_m(Vec3 v) const { return origin_m + direction_m(v); }
};

/// Adds the plant's stems; its trunks spring from `parent` (-1: they are trunks).
void copy_stems(const Plant& plant, const CopyFrame& frame, std::int32_t parent, StemSplines& stems);

/// Adds the plant's leaves to those of a plant whose leaves have the shape `leaf_shape`: as leaves where that
/// is theirs, else as triangles.
void copy_leaves(const Plant& plant, const CopyFrame& frame, int leaf_shape, Leaves& leaves,
                 std::vector<ColoredTriangle>& triangles);

}  // namespace espalier::lsystem
