// The room that an outline leaves to a trained tree.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include <espalier/image/masks/morphology.h>
#include <espalier/image/reading/room_to_grow.h>

#include "support/random_masks.h"

namespace espalier {
namespace {

constexpr int kSize = 128, kReach = 2;

bool is_inside(const Mask& part, const Mask& whole) {
  for (std::size_t w = 0; w < part.words().size(); ++w)
    if (part.words()[w] & ~whole.words()[w]) return false;
  return true;
}

Mask disc_with_twig() {
  Mask mask(kSize, kSize);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x)
      if (std::hypot(x - 40, y - 64) < 30 || (y == 64 && x >= 40 && x < 110)) mask.set(x, y);
  return mask;
}

RC_GTEST_PROP(RoomToGrow, HoldsTheOutlineAndGoesNoFurtherThanItsReach, ()) {
  const int blobs = *rc::gen::inRange(0, 12).as("blobs");
  const Mask outline = test::random_mask(kSize, kSize, blobs, *rc::gen::arbitrary<Seed>().as("seed"));
  const Mask room = room_to_grow(outline, Mask(kSize, kSize));
  RC_ASSERT(is_inside(outline, room));
  RC_ASSERT(is_inside(room, dilate_disc(outline, kReach)));
}

TEST(RoomToGrow, IsBesideThinPartsOnly) {
  const Mask room = room_to_grow(disc_with_twig(), disc_with_twig());
  EXPECT_TRUE(room.get(90, 64 + kReach) && room.get(90, 64 - kReach)) << "beside the twig";
  EXPECT_FALSE(room.get(90, 64 + kReach + 1)) << "further than the reach";
  for (const int side : {-1, 1}) EXPECT_FALSE(room.get(40, 64 + side * 30)) << "beside the disc";
}

TEST(RoomToGrow, IsBetweenRootsToo) {
  Mask mask(kSize, kSize);
  for (int y = 10; y < 120; ++y)
    for (int x = 56; x < 72; ++x)
      if (y < 110 || x < 61 || x >= 67) mask.set(x, y);
  for (int x = 30; x < 100; ++x) mask.set(x, 10);
  const Mask room = room_to_grow(mask, mask);
  for (int y = 110; y < 120; ++y) EXPECT_TRUE(room.get(64, y)) << y;
}

}  // namespace
}  // namespace espalier
