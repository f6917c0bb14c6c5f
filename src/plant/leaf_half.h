// The right half of a leaf's outline as edges: what a point is tested against. Unit length, no unit.
#pragma once
#include <cstddef>
#include <vector>

namespace espalier {

struct LeafHalf {
  /// x = at_zero + slope·y for y in [y0, y1).
  struct Edge {
    float y0, y1, at_zero, slope;
  };
  std::vector<Edge> edges;
  std::size_t chain = 0;  ///< the first edges, from bottom to top, each from where the one before ends
  float half_width = 0;

  /// x (not negative) and y of the outline: inside where an odd number of edges lie to the right.
  bool contains(float x, float y) const {
    bool inside = false;
    for (const Edge& edge : edges)
      inside ^= (y >= edge.y0) & (y < edge.y1) & (x < edge.at_zero + edge.slope * y);
    return inside;
  }
};

/// The half of leaf_outline(shape). The reference stays valid.
const LeafHalf& leaf_half(int shape);

}  // namespace espalier
