#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include <espalier/core/error.h>
#include <espalier/image/measures/compare.h>
#include <espalier/image/reading/frame.h>
#include <espalier/image/reading/read_target.h>

#include "support/picture_files.h"
#include "support/random_masks.h"

namespace espalier {
namespace {

Mask rectangle(int size_px, int left, int top, int right, int bottom) {
  Mask mask(size_px, size_px);
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x) mask.set(x, y);
  return mask;
}

struct Box {
  int left = 1 << 30, top = 1 << 30, right = 0, bottom = 0;  ///< ends exclusive
};

Box pixel_box_of(const Mask& mask) {
  Box box;
  for (int y = 0; y < mask.height_px(); ++y)
    for (int x = 0; x < mask.width_px(); ++x) {
      if (!mask.get(x, y)) continue;
      box = {std::min(box.left, x), std::min(box.top, y), std::max(box.right, x + 1), y + 1};
    }
  return box;
}

TEST(Frame, TallTreesTake92PercentOfTheHeight) {
  for (const int size : {64, 128, 256, 512}) {
    const TargetPicture framed = frame_mask(rectangle(300, 100, 50, 110, 250), size);
    const Box box = pixel_box_of(framed.mask);
    EXPECT_NEAR(framed.tree_height_px, 0.92f * size, 1e-3f);
    EXPECT_NEAR(box.bottom - box.top, 0.92 * size, 1.0);
    EXPECT_NEAR(box.bottom, base_row_px(size), 0.51);
    EXPECT_NEAR(0.5 * (box.left + box.right), 0.5 * size, 0.51);
  }
}

TEST(Frame, WideTreesTake48PercentToTheFartherSide) {
  Mask mask = rectangle(300, 20, 100, 180, 140);  // a crown that reaches 130 px to the left
  for (int y = 140; y < 200; ++y)
    for (int x = 148; x < 152; ++x) mask.set(x, y);  // of its trunk, and 30 px to the right
  const Box box = pixel_box_of(frame_mask(mask, 256).mask);
  EXPECT_NEAR(box.left, 128 - 0.48 * 256, 1.0);
  EXPECT_NEAR(box.right, 128 + 0.48 * 256 * 30 / 130, 1.0);
}

RC_GTEST_PROP(Frame, TheWholeTreeLiesInTheFrame, ()) {
  const int width = *rc::gen::inRange(40, 120), height = *rc::gen::inRange(40, 120);
  const Mask mask =
      test::random_mask(width, height, *rc::gen::inRange(5, 12), *rc::gen::arbitrary<Seed>().as("seed"));
  RC_PRE(area_px(mask) > 20);
  const int size = *rc::gen::inRange(32, 300);
  const Mask framed = frame_mask(mask, size).mask;
  const Box box = pixel_box_of(framed);
  RC_ASSERT(box.left >= 0.02 * size - 1 && box.right <= 0.98 * size + 1);
  RC_ASSERT(box.bottom <= base_row_px(size) + 1);
  RC_ASSERT(box.top >= base_row_px(size) - 0.92 * size - 1);
}

TEST(Frame, PlaceAndScaleInThePictureDoNotMatter) {
  const Mask here = test::drawn_tree_mask(400), enlarged = test::drawn_tree_mask(800);
  Mask shifted(500, 450);
  for (int y = 0; y < 400; ++y)
    for (int x = 0; x < 400; ++x) shifted.set(x + 90, y + 37, here.get(x, y));
  const Mask framed = frame_mask(here, 256).mask;
  EXPECT_EQ(frame_mask(shifted, 256).mask, framed);
  EXPECT_GT(iou(frame_mask(enlarged, 256).mask, framed), 0.985);
}

TEST(Frame, ScalingKeepsTheArea) {
  const Mask source = test::drawn_tree_mask(700);
  for (const int size : {64, 200, 256, 1000}) {
    const TargetPicture framed = frame_mask(source, size);
    const double expected = static_cast<double>(area_px(source)) * std::pow(framed.frame_px_per_source_px, 2);
    EXPECT_NEAR(static_cast<double>(area_px(framed.mask)) / expected, 1.0, size < 100 ? 0.03 : 0.01) << size;
  }
}

TEST(Frame, AFramedMaskOfTheSameSizeStaysAsItIs) {
  const Mask framed = frame_mask(test::drawn_tree_mask(700), 256).mask;
  EXPECT_GT(iou(frame_mask(framed, 256).mask, framed), 0.98);
}

TEST(Frame, AnEmptyMaskIsRefused) { EXPECT_THROW(frame_mask(Mask(64, 64), 256), InputError); }

}  // namespace
}  // namespace espalier
