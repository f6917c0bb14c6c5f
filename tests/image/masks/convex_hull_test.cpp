// Laws of the convex hull's area, for random masks, and boxes of masks.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <espalier/image/masks/convex_hull.h>
#include <espalier/image/masks/mask_box.h>

#include "support/random_masks.h"

namespace espalier {
namespace {

Mask filled_box(const Mask& mask) {
  const MaskBox box = box_of(mask);
  Mask filled(mask.width_px(), mask.height_px());
  for (int y = box.top; y < box.bottom; ++y)
    for (int x = box.left; x < box.right; ++x) filled.set(x, y);
  return filled;
}

RC_GTEST_PROP(ConvexHull, LiesBetweenTheMaskAndItsBox, ()) {
  const Mask mask = test::draw_mask(90);
  const double hull_px = convex_hull_area_px(mask);
  RC_ASSERT(hull_px >= static_cast<double>(area_px(mask)));
  RC_ASSERT(hull_px <= static_cast<double>(area_px(filled_box(mask))));
}

RC_GTEST_PROP(ConvexHull, OfABoxIsTheBox, ()) {
  const Mask box = filled_box(test::draw_mask(90));
  RC_ASSERT(convex_hull_area_px(box) == static_cast<double>(area_px(box)));
}

RC_GTEST_PROP(ConvexHull, GrowsWithTheMask, ()) {
  const auto [a, b] = test::draw_pair(90);
  Mask both = a;
  for (std::size_t i = 0; i < both.words().size(); ++i) both.words()[i] |= b.words()[i];
  RC_ASSERT(convex_hull_area_px(both) >= convex_hull_area_px(a));
}

TEST(ConvexHull, OfTwoPixelsOnADiagonalIsAHexagon) {
  Mask mask(8, 8);
  mask.set(1, 1), mask.set(4, 4);
  EXPECT_DOUBLE_EQ(convex_hull_area_px(mask), 16 - 2 * 4.5);
}

TEST(MaskBox, HoldsWhatIsSetAndNothingElse) {
  Mask mask(70, 9);
  EXPECT_TRUE(box_of(mask).is_empty());
  mask.set(3, 2), mask.set(68, 7);
  const MaskBox box = box_of(mask);
  EXPECT_EQ(box.left, 3);
  EXPECT_EQ(box.right, 69);
  EXPECT_EQ(box.top, 2);
  EXPECT_EQ(box.bottom, 8);
}

}  // namespace
}  // namespace espalier
