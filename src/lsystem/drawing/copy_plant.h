// Copies of a plant in another: what an L-system's `plant` statement grew, placed by the turtle.
#pragma once
#include <vector>

#include <espalier/lsystem/drawing/stem_splines.h>
#include <espalier/lsystem/surfaces/triangle_leaves.h>
#include <espalier/plant/joints.h>

namespace espalier::lsystem {

/// Where a copy stands, and what the plant's axes become: metres of one unit along each.
struct CopyFrame {
  Vec3 origin_m, x_m, y_m, z_m;

  Vec3 direction_m(Vec3 v) const { return x_m * v.x + y_m * v.y + z_m * v.z; }
  Vec3 point_m(Vec3 v) const { return origin_m + direction_m(v); }
};

/// Adds the plant's stems; its trunks spring from `parent` (-1: they are trunks). Returns what each became.
std::vector<std::int32_t> copy_stems(const JointedPlant& from, const CopyFrame& frame, std::int32_t parent,
                                     StemSplines& stems);

/// Adds the plant's organs, on the copies of their stems; those on none hang where `base` does.
void copy_organs(const JointedPlant& from, const std::vector<std::int32_t>& copies, const Organ& base,
                 std::vector<Organ>& organs);

/// Whether the plant's leaves can be leaves of a plant whose leaves have the shape `leaf_shape`: they have it
/// too, and are no triangles that share shades.
bool is_copied_as_leaves(const Plant& plant, int leaf_shape);

/// Adds the plant's leaves to those of a plant whose leaves have the shape `leaf_shape`: as leaves where they
/// can be, else as triangles. Their organs are numbered from `first_organ`.
void copy_leaves(const JointedPlant& from, const CopyFrame& frame, int leaf_shape, std::uint32_t first_organ,
                 Leaves& leaves, std::vector<std::uint32_t>& organ_of_leaf,
                 std::vector<ColoredTriangle>& triangles);

}  // namespace espalier::lsystem
