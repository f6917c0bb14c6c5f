#include "plant/leaf_half.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "plant/leaf_outlines.h"

namespace espalier {

namespace {

constexpr int kShapes = 11;

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
  half.is_chain = std::ranges::adjacent_find(half.edges, [](const auto& a, const auto& b) {
                    return a.y1 != b.y0;
                  }) == half.edges.end();
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
