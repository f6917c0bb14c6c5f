// What is wrong with pictures of trees: those of the project are sound, and each way to spoil one is found.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include <espalier/image/reading/picture_faults.h>
#include <espalier/image/reading/read_target.h>

namespace espalier {
namespace {

namespace fs = std::filesystem;

struct Window {
  int left, top, right, bottom;  ///< ends exclusive
};

Mask cut(const Mask& mask, const Window& window) {
  Mask part(window.right - window.left, window.bottom - window.top);
  for (int y = window.top; y < window.bottom; ++y)
    for (int x = window.left; x < window.right; ++x)
      if (mask.get(x, y)) part.set(x - window.left, y - window.top);
  return part;
}

Window trimmed(const Mask& mask) {
  Window box{mask.width_px(), mask.height_px(), 0, 0};
  for (int y = 0; y < mask.height_px(); ++y)
    for (int x = 0; x < mask.width_px(); ++x)
      if (mask.get(x, y))
        box = {std::min(box.left, x), std::min(box.top, y), std::max(box.right, x + 1),
               std::max(box.bottom, y + 1)};
  return box;
}

Mask target(const std::string& name) {
  return read_mask(fs::path(ESPALIER_SOURCE_DIR) / "targets" / (name + ".png"), {}).mask;
}

/// Side by side, on one ground.
Mask beside(const Mask& a, const Mask& b) {
  Mask both(a.width_px() + b.width_px(), std::max(a.height_px(), b.height_px()));
  int left = 0;
  for (const Mask* mask : {&a, &b}) {
    for (int y = 0; y < mask->height_px(); ++y)
      for (int x = 0; x < mask->width_px(); ++x)
        if (mask->get(x, y)) both.set(left + x, both.height_px() - mask->height_px() + y);
    left += mask->width_px();
  }
  return both;
}

const char* const kTrees[] = {"tr_birch", "tr_fir", "oc_orange", "oc_palm", "tr_crookedtree4", "oc_cypress"};

TEST(PictureFaults, ThereAreNoneInTheBundledPictures) {
  for (const auto& entry : fs::directory_iterator(fs::path(ESPALIER_SOURCE_DIR) / "targets"))
    if (entry.path().extension() == ".png") {
      EXPECT_FALSE(picture_faults(read_mask(entry.path(), {}).mask).any()) << entry.path();
    }
}

TEST(PictureFaults, ATightFrameIsNoFault) {
  for (const char* name : kTrees) {
    const Mask mask = target(name);
    EXPECT_FALSE(picture_faults(cut(mask, trimmed(mask))).any()) << name;
  }
}

TEST(PictureFaults, WhatIsCutOffIsFoundAtThatEdgeAndAtNoOther) {
  for (const char* name : kTrees) {
    const Mask mask = target(name);
    const Window box = trimmed(mask);
    const int width = box.right - box.left, height = box.bottom - box.top;
    const PictureFaults left = picture_faults(cut(mask, {box.left + width * 3 / 10, 0, 512, 512})),
                        right = picture_faults(cut(mask, {0, 0, box.right - width * 3 / 10, 512})),
                        top = picture_faults(cut(mask, {0, box.top + height / 5, 512, 512}));
    EXPECT_TRUE(left.cut_left && !left.cut_right && !left.cut_top && !left.cut_below) << name;
    EXPECT_TRUE(right.cut_right && !right.cut_left && !right.cut_top && !right.cut_below) << name;
    EXPECT_TRUE(top.cut_top && !top.cut_left && !top.cut_right && !top.cut_below) << name;
  }
}

TEST(PictureFaults, ACrownThatRunsIntoTheLowerEdgeIsNoTrunk) {
  for (const char* name : {"tr_birch", "tr_fir", "oc_orange"}) {
    const Mask mask = target(name);
    const Window box = trimmed(mask);
    const int cut_at = box.top + (box.bottom - box.top) * 6 / 10;
    EXPECT_TRUE(picture_faults(cut(mask, {0, 0, 512, cut_at})).cut_below) << name;
  }
}

TEST(PictureFaults, TreesSideBySideAreCountedAndTheLargestIsTaken) {
  const Mask orange = target("oc_orange"), birch = target("tr_birch"), palm = target("oc_palm");
  const Mask two = beside(palm, orange), three = beside(two, birch);
  EXPECT_EQ(picture_faults(two).trees, 2);
  EXPECT_EQ(picture_faults(three).trees, 3);
  EXPECT_EQ(differing_px(largest_tree(two), beside(Mask(512, 512), orange)), 0u);
  EXPECT_EQ(largest_tree(orange), orange);
}

TEST(PictureFaults, APieceThatFloatsOrIsSmallIsNoTree) {
  Mask scene = beside(target("oc_orange"), Mask(200, 512));
  for (int y = 20; y < 120; ++y)
    for (int x = 560; x < 660; ++x) scene.set(x, y);  // a cloud
  for (int y = 480; y < 490; ++y)
    for (int x = 560; x < 580; ++x) scene.set(x, y);  // a stone
  EXPECT_EQ(picture_faults(scene).trees, 1);
}

TEST(PictureFaults, EachHasOneLine) {
  EXPECT_TRUE(describe({}, true).empty());
  const auto lines = describe({true, true, false, true, 2}, true);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_THAT(lines[0], testing::HasSubstr("left and the right edge"));
  EXPECT_THAT(lines[1], testing::HasSubstr("lower edge"));
  EXPECT_THAT(lines[2], testing::HasSubstr("2 trees in the picture: the largest"));
}

}  // namespace
}  // namespace espalier
