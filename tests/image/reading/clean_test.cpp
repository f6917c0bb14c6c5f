#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <utility>
#include <vector>

#include <espalier/image/masks/morphology.h>
#include <espalier/image/reading/clean.h>

#include "support/random_masks.h"

namespace espalier {
namespace {

using test::is_subset;

/// A noise mask: pieces of all sizes and shapes.
Mask draw_noise(int max_side_px) {
  const int width = *rc::gen::inRange(1, max_side_px + 1), height = *rc::gen::inRange(1, max_side_px + 1);
  const float density = *rc::gen::element(0.1f, 0.35f, 0.5f);
  const RandomKey key = root_key(*rc::gen::arbitrary<Seed>());
  Mask mask(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) mask.set(x, y, uniform_unit(key, y, x) < density);
  return mask;
}

/// Floods each piece by a stack of pixels.
Mask large_pieces_pixel_by_pixel(const Mask& mask, std::size_t min_area_px, Connectivity connectivity) {
  Mask seen(mask.width_px(), mask.height_px()), large = seen;
  for (int y = 0; y < mask.height_px(); ++y)
    for (int x = 0; x < mask.width_px(); ++x) {
      if (!mask.get(x, y) || seen.get(x, y)) continue;
      std::vector<std::pair<int, int>> piece{{x, y}};
      seen.set(x, y);
      for (std::size_t i = 0; i < piece.size(); ++i)
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) {
            const int u = piece[i].first + dx, v = piece[i].second + dy;
            if (connectivity == Connectivity::four && dx != 0 && dy != 0) continue;
            if (u < 0 || v < 0 || u >= mask.width_px() || v >= mask.height_px()) continue;
            if (!mask.get(u, v) || seen.get(u, v)) continue;
            seen.set(u, v);
            piece.emplace_back(u, v);
          }
      if (piece.size() < min_area_px) continue;
      for (const auto& [u, v] : piece) large.set(u, v);
    }
  return large;
}

RC_GTEST_PROP(Clean, LargePiecesAreThoseAFloodFinds, ()) {
  const Mask mask = draw_noise(90);
  const auto area = *rc::gen::inRange<std::size_t>(1, 30);
  for (const Connectivity connectivity : {Connectivity::four, Connectivity::eight})
    RC_ASSERT(large_pieces(mask, area, connectivity) ==
              large_pieces_pixel_by_pixel(mask, area, connectivity));
}

RC_GTEST_PROP(Clean, SpecksAreOnlyTakenAwayAndOnlyOnce, ()) {
  const Mask mask = draw_noise(90);
  const Mask cleaned = remove_specks(mask, 10);
  RC_ASSERT(is_subset(cleaned, mask));
  RC_ASSERT(is_subset(large_pieces(mask, 10, Connectivity::eight), cleaned));
  RC_ASSERT(remove_specks(cleaned, 10) == cleaned);
}

TEST(Clean, LooseLeavesNearTheCrownStay) {
  Mask mask(256, 256);
  for (int y = 100; y < 150; ++y)
    for (int x = 100; x < 150; ++x) mask.set(x, y);
  mask.set(153, 120);  // within 256/64 = 4 px of the crown
  mask.set(170, 120);
  const Mask cleaned = remove_specks(mask, 10);
  EXPECT_TRUE(cleaned.get(153, 120));
  EXPECT_FALSE(cleaned.get(170, 120));
}

TEST(Clean, PinholesAreFilledAndLargerHolesKept) {
  Mask mask(64, 64);
  for (int y = 10; y < 50; ++y)
    for (int x = 10; x < 50; ++x) mask.set(x, y);
  mask.set(20, 20, false);
  for (int x = 30; x < 40; ++x) mask.set(x, 30, false);
  const Mask filled = fill_pinholes(mask, 5);
  EXPECT_TRUE(filled.get(20, 20));
  EXPECT_FALSE(filled.get(35, 30));
  EXPECT_EQ(area_px(filled), area_px(mask) + 1);
}

RC_GTEST_PROP(Clean, FillingAllPinholesFillsAllHoles, ()) {
  const Mask mask = draw_noise(60);
  RC_ASSERT(fill_pinholes(mask, 1'000'000) == fill_holes(mask));
}

}  // namespace
}  // namespace espalier
