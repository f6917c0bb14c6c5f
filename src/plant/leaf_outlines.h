// Unit outlines of leaves and blossoms: length 1 from the stalk at the origin to the tip at y = 1, no unit.
// Leaves are flat (z = 0) and symmetric in x; widths and areas are those of the published ones
// (Hewitt 2017, Appendix C, leaf_shape and blossom_shape), the drawings are ours.
// plant/plant.h says how an outline is scaled and placed. To add a leaf shape, name it here and draw its half
// in leaf_outlines.cpp: both models, their bounds and their docs take the names from here.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <espalier/core/vec3.h>

namespace espalier {

struct LeafOutline {
  /// Of a leaf: the boundary, counter-clockwise seen from +z, starting at the stalk. Of a blossom: a 3D mesh.
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Of the leaf shapes 1, 2, …
inline constexpr std::array<const char*, 10> kLeafShapes{"ovate",     "linear",    "cordate",     "maple",
                                                         "palmate",   "spiky_oak", "rounded_oak", "elliptic",
                                                         "rectangle", "triangle"};

/// Of the blossoms 1, 2, …
inline constexpr std::array<const char*, 3> kBlossomShapes{"cherry", "orange", "magnolia"};

/// Leaf shape 1 to kLeafShapes.size(); 0 is elliptic. Throws InternalError for any other. The reference stays
/// valid.
const LeafOutline& leaf_outline(int shape);

/// Blossom 1 to kBlossomShapes.size(): cups opening along +y, about 1.3 wide and 0.5 to 0.7 tall.
/// Throws InternalError for any other. The reference stays valid.
const LeafOutline& blossom_outline(int shape);

/// The area of leaves of this shape, one side of each, by their lengths and widths (of the same number).
double leaf_area_m2(std::span<const float> lengths_m, std::span<const float> widths_m, int shape);

}  // namespace espalier
