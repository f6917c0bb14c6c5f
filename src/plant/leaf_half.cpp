#include <algorithm>
#include <array>

#include <espalier/core/error.h>
#include <espalier/plant/leaf_half.h>
#include <espalier/plant/leaf_outlines.h>

namespace espalier {

namespace {

constexpr int kShapes = static_cast<int>(kLeafShapes.size()) + 1;  ///< with 0

/// Moves a chain of edges to the front, the lowest one first; its length.
std::size_t chain_edges(std::vector<LeafHalf::Edge>& edges) {
  std::ranges::stable_sort(edges, {}, &LeafHalf::Edge::y0);
  std::size_t chain = 1;
  for (std::size_t i = 1; i < edges.size(); ++i)
    if (edges[i].y0 == edges[chain - 1].y1) {
      std::rotate(edges.begin() + static_cast<std::ptrdiff_t>(chain),
                  edges.begin() + static_cast<std::ptrdiff_t>(i),
                  edges.begin() + static_cast<std::ptrdiff_t>(i) + 1);
      ++chain;
    }
  return chain;
}

LeafHalf right_half(const LeafOutline& outline) {
  LeafHalf half;
  for (std::size_t i = 0; i + 1 < outline.vertices.size(); ++i) {
    Vec3 a = outline.vertices[i], b = outline.vertices[i + 1];
    half.half_width = std::max({half.half_width, a.x, b.x});
    if (a.x < 0 || b.x < 0 || a.y == b.y) continue;
    if (a.y > b.y) std::swap(a, b);
    const float slope = (b.x - a.x) / (b.y - a.y);
    half.edges.push_back({a.y, b.y, a.x - slope * a.y, slope});
  }
  half.chain = chain_edges(half.edges);
  return half;
}

std::array<LeafHalf, kShapes> make_halves() {
  std::array<LeafHalf, kShapes> halves;
  for (int shape = 0; shape < kShapes; ++shape)
    halves[static_cast<std::size_t>(shape)] = right_half(leaf_outline(shape));
  return halves;
}

}  // namespace

const LeafHalf& leaf_half(int shape) {
  static const std::array<LeafHalf, kShapes> halves = make_halves();
  ESPALIER_CHECK_EQ(shape >= 0 && shape < kShapes, true);
  return halves[static_cast<std::size_t>(shape)];
}

}  // namespace espalier
