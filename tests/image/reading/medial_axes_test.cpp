// The axes of drawn trees, of which lengths, widths and places are known.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include <espalier/image/reading/medial_axes.h>

#include "support/random_masks.h"

namespace espalier {
namespace {

void draw_line(Mask& mask, PixelPoint from, PixelPoint to, float radius_px) {
  for (int y = 0; y < mask.height_px(); ++y)
    for (int x = 0; x < mask.width_px(); ++x) {
      const float px = static_cast<float>(x) + 0.5f - from.x, py = static_cast<float>(y) + 0.5f - from.y;
      const float dx = to.x - from.x, dy = to.y - from.y;
      const float t = std::clamp((px * dx + py * dy) / (dx * dx + dy * dy), 0.f, 1.f);
      if (std::hypot(px - t * dx, py - t * dy) <= radius_px) mask.set(x, y);
    }
}

/// A trunk with a branch to the right that leaves it at half its height.
Mask one_branch() {
  Mask mask(128, 128);
  draw_line(mask, {64, 120}, {64, 10}, 4);
  draw_line(mask, {64, 65}, {110, 40}, 2);
  return mask;
}

TEST(MedialAxes, AnEmptyMaskHasNone) { EXPECT_TRUE(medial_axes(Mask(32, 32), 3).empty()); }

TEST(MedialAxes, APoleIsATrunk) {
  Mask mask(64, 128);
  draw_line(mask, {30, 120}, {34, 10}, 3);
  const auto axes = medial_axes(mask, 5);
  ASSERT_EQ(axes.size(), 1u);
  EXPECT_EQ(axes[0].parent, -1);
  EXPECT_NEAR(axes[0].length_px, 113, 6);
  EXPECT_NEAR(axes[0].width_px, 6, 1.5);
  EXPECT_NEAR(axes[0].points.front().x, 30, 2);
  EXPECT_NEAR(axes[0].points.back().x, 34, 2);
  EXPECT_GT(axes[0].points.front().y, axes[0].points.back().y);
}

TEST(MedialAxes, ABranchLeavesTheTrunkWhereItIsDrawn) {
  const auto axes = medial_axes(one_branch(), 8);
  ASSERT_EQ(axes.size(), 2u);
  EXPECT_EQ(axes[1].parent, 0);
  EXPECT_NEAR(axes[1].start, 0.5, 0.05);
  EXPECT_NEAR(axes[1].points.back().x, 110, 4);
  EXPECT_NEAR(axes[1].points.back().y, 40, 4);
  EXPECT_LT(axes[1].width_px, axes[0].width_px);
}

TEST(MedialAxes, AreAsWideAsTheMaskAlongThem) {
  Mask mask = one_branch();
  draw_line(mask, {64, 140}, {64, 100}, 4);  // to the picture's edge
  const auto axes = medial_axes(mask, 8);
  ASSERT_EQ(axes.size(), 2u);
  for (std::size_t i = 10; i + 10 < axes[0].widths_px.size(); ++i) EXPECT_NEAR(axes[0].widths_px[i], 8, 1.5);
  EXPECT_NEAR(axes[0].widths_px.front(), 8, 2) << "discs do not end with the foot";
  EXPECT_NEAR(axes[1].widths_px[axes[1].widths_px.size() / 2], 4, 1.5);
  EXPECT_EQ(axes[1].widths_px.size(), axes[1].points.size());
}

RC_GTEST_PROP(MedialAxes, BearEachOtherInNoMoreLevelsThanAsked, ()) {
  const Mask mask = test::draw_mask(40);
  const int levels = *rc::gen::inRange(2, 5);
  const auto axes = medial_axes(mask, 2, levels);
  std::vector<int> level;
  for (const MedialAxis& axis : axes) {
    level.push_back(axis.parent < 0 ? 1 : level[static_cast<std::size_t>(axis.parent)] + 1);
    RC_ASSERT(level.back() <= levels);
  }
  RC_ASSERT(axes.empty() == medial_axes(mask, 2).empty());
}

TEST(MedialAxes, AxesShorterThanAskedAreLeftOut) { EXPECT_EQ(medial_axes(one_branch(), 70).size(), 1u); }

TEST(MedialAxes, WhatNoPathJoinsToTheFootHasNoAxis) {
  Mask mask = one_branch();
  draw_line(mask, {10, 60}, {30, 20}, 2);
  EXPECT_EQ(medial_axes(mask, 8).size(), 2u);
}

RC_GTEST_PROP(MedialAxes, FormATreeFromTheFootUp, ()) {
  const Mask mask = test::draw_mask(40);
  const auto axes = medial_axes(mask, 2);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    RC_ASSERT(axes[i].points.size() >= 2u);
    RC_ASSERT((axes[i].parent == -1) == (i == 0));
    RC_ASSERT(axes[i].parent < static_cast<int>(i));
    RC_ASSERT(axes[i].start >= 0 && axes[i].start <= 1);
    for (const PixelPoint point : axes[i].points) {
      RC_ASSERT(point.x >= 0 && point.x <= static_cast<float>(mask.width_px()));
      RC_ASSERT(point.y >= 0 && point.y <= static_cast<float>(mask.height_px()));
    }
  }
}

TEST(MedialAxes, EvenlySpacedPointsKeepBothEnds) {
  const std::vector<PixelPoint> line{{0, 0}, {3, 0}, {3, 4}, {3, 5}};
  const auto points = evenly_spaced(line, 9);
  ASSERT_EQ(points.size(), 9u);
  EXPECT_EQ(points.front().x, 0);
  EXPECT_EQ(points.back().y, 5);
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
    EXPECT_NEAR(points[i].x + points[i].y, static_cast<double>(i), 1e-5);
}

}  // namespace
}  // namespace espalier
