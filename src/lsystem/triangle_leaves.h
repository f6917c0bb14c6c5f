// Triangles in a plant: each as a leaf of the triangular outline (plant/leaf_outlines.h, shape 10), whose
// side and axis need not be at right angles.
#pragma once
#include <vector>

#include "lsystem/polygon.h"
#include "plant/plant.h"

namespace espalier::lsystem {

struct ColoredTriangle {
  Triangle corners;
  PartColor color;
};

/// Turns the plant's leaves into triangles, adds these, and gives it the triangular outline; blossoms stay.
/// Triangles without an area are left out.
void draw_as_triangles(const std::vector<ColoredTriangle>& triangles, Plant& plant);

}  // namespace espalier::lsystem
