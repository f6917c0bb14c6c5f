#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstdlib>
#include <utility>
#include <vector>

#include <espalier/image/masks/morphology.h>

#include "support/random_masks.h"

namespace espalier {
namespace {

using test::draw_mask;
using test::is_subset;

template <typename Reaches>
Mask dilate_pixel_by_pixel(const Mask& mask, int reach_px, Reaches reaches) {
  Mask result(mask.width_px(), mask.height_px());
  for (int y = 0; y < mask.height_px(); ++y)
    for (int x = 0; x < mask.width_px(); ++x)
      for (int v = std::max(0, y - reach_px); v <= std::min(mask.height_px() - 1, y + reach_px); ++v)
        for (int u = std::max(0, x - reach_px); u <= std::min(mask.width_px() - 1, x + reach_px); ++u)
          if (mask.get(u, v) && reaches(x - u, y - v)) result.set(x, y);
  return result;
}

RC_GTEST_PROP(Morphology, DilationsEqualTheirDefinitions, ()) {
  const Mask mask = draw_mask(140);
  const int r = *rc::gen::inRange(1, 7);
  Mask plus, square;
  dilate_plus(mask, plus);
  dilate_square(mask, square);
  RC_ASSERT(plus ==
            dilate_pixel_by_pixel(mask, 1, [](int dx, int dy) { return std::abs(dx) + std::abs(dy) <= 1; }));
  RC_ASSERT(square == dilate_pixel_by_pixel(mask, 1, [](int, int) { return true; }));
  RC_ASSERT(dilate_disc(mask, r) ==
            dilate_pixel_by_pixel(mask, r, [r](int dx, int dy) { return dx * dx + dy * dy <= r * r; }));
}

RC_GTEST_PROP(Morphology, ClosingIsExtensive, ()) {
  const Mask mask = draw_mask(150);
  RC_ASSERT(is_subset(mask, close_disc(mask, *rc::gen::inRange(0, 9))));
}

RC_GTEST_PROP(Morphology, ClosingIsIdempotent, ()) {
  const Mask mask = draw_mask(150);
  const int radius = *rc::gen::inRange(0, 9);
  const Mask once = close_disc(mask, radius);
  RC_ASSERT(close_disc(once, radius) == once);
}

RC_GTEST_PROP(Morphology, ClosingKeepsOrder, ()) {
  const auto [a, b] = test::draw_pair(120);
  Mask both = a;
  for (std::size_t i = 0; i < both.words().size(); ++i) both.words()[i] |= b.words()[i];
  RC_ASSERT(is_subset(close_disc(a, 4), close_disc(both, 4)));
}

RC_GTEST_PROP(Morphology, ComplementTwiceIsTheMask, ()) {
  const Mask mask = draw_mask(150);
  RC_ASSERT(complement(complement(mask)) == mask);
  RC_ASSERT(area_px(mask) + area_px(complement(mask)) ==
            static_cast<std::size_t>(mask.width_px()) * mask.height_px());
}

/// Background reached from the border by a stack of pixels, 4-connected.
Mask fill_holes_pixel_by_pixel(const Mask& mask) {
  Mask outside(mask.width_px(), mask.height_px());
  std::vector<std::pair<int, int>> stack;
  const auto visit = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= mask.width_px() || y >= mask.height_px()) return;
    if (mask.get(x, y) || outside.get(x, y)) return;
    outside.set(x, y);
    stack.emplace_back(x, y);
  };
  for (int y = 0; y < mask.height_px(); ++y)
    for (int x = 0; x < mask.width_px(); ++x)
      if (x == 0 || y == 0 || x == mask.width_px() - 1 || y == mask.height_px() - 1) visit(x, y);
  while (!stack.empty()) {
    const auto [x, y] = stack.back();
    stack.pop_back();
    visit(x - 1, y), visit(x + 1, y), visit(x, y - 1), visit(x, y + 1);
  }
  return complement(outside);
}

RC_GTEST_PROP(Morphology, FilledHolesAreThoseABorderFloodMisses, ()) {
  const int width = *rc::gen::inRange(1, 200), height = *rc::gen::inRange(1, 60);
  const auto seed = *rc::gen::arbitrary<Seed>();
  Mask noise(width, height);  // near the percolation threshold: winding paths, many holes
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) noise.set(x, y, uniform_unit(root_key(seed), y, x) < 0.42f);
  RC_ASSERT(fill_holes(noise) == fill_holes_pixel_by_pixel(noise));
}

TEST(Morphology, FloodFollowsASpiral) {
  Mask spiral(130, 130);  // walls of a spiral corridor one pixel wide: nothing is a hole
  int left = 0, top = 0, right = 129, bottom = 129;
  for (; right - left > 8; left += 2, top += 2, right -= 2, bottom -= 2) {
    for (int x = left; x <= right; ++x) spiral.set(x, bottom), spiral.set(x, top);
    for (int y = top; y <= bottom; ++y) spiral.set(right, y), spiral.set(left, y);
    spiral.set(left, top + 1, false);
  }
  EXPECT_EQ(fill_holes(spiral), fill_holes_pixel_by_pixel(spiral));
}

}  // namespace
}  // namespace espalier
