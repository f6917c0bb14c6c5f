// Triangles in a plant: each as a leaf of the triangular outline (plant/leaf_outlines.h, shape 10), whose
// side and axis need not be at right angles.
#pragma once
#include <vector>

#include <espalier/lsystem/surfaces/polygon.h>
#include <espalier/plant/plant.h>

namespace espalier::lsystem {

struct ColoredTriangle {
  Triangle corners;
  PartColor color;
  std::uint32_t organ = 0;  ///< it belongs to (plant/joints.h)
  bool is_plain = false;    ///< of a polygon: many of them may be one leaf, so their shade is the same
};

/// Turns the plant's leaves into triangles, adds these, and gives it the triangular outline; blossoms stay.
/// Triangles without an area are left out. `organ_of_leaf` is rewritten with the leaves. All triangles of an
/// organ have one shade, those of polygons the plain one.
void draw_as_triangles(const std::vector<ColoredTriangle>& triangles, Plant& plant,
                       std::vector<std::uint32_t>& organ_of_leaf);

}  // namespace espalier::lsystem
