// The trunk in pictures that are drawn here, row by row.
#include <gtest/gtest.h>

#include <functional>

#include <espalier/fitting/picture/trunk_measures.h>

namespace espalier {
namespace {

/// 100 rows, each as wide as the function of its height above the ground says, centred; odd widths.
Mask tree_of_rows(const std::function<int(int)>& width_px) {
  Mask mask(128, 110);
  for (int height = 0; height < 100; ++height) {
    const int half = width_px(height) / 2;
    for (int x = 64 - half; x <= 64 + half; ++x) mask.set(x, 105 - height);
  }
  return mask;
}

TrunkMeasures measures_of(const Mask& mask) { return measure_trunk(mask, box_of(mask)); }

TEST(TrunkMeasures, ATrunkBelowACrown) {
  const TrunkMeasures trunk = measures_of(tree_of_rows([](int h) { return h < 30 ? 9 : 51; }));
  EXPECT_EQ(trunk.width_px, 9);
  EXPECT_EQ(trunk.bare_px, 30);
  EXPECT_EQ(trunk.foot_width_px, 9);
  EXPECT_EQ(trunk.stems, 1);
  EXPECT_EQ(trunk.stand_px, 0);
}

TEST(TrunkMeasures, AMoundIsNoTrunk) {
  const auto width_px = [](int h) { return h < 3 ? 15 : h < 12 ? 31 : h < 30 ? 9 : 51; };
  const TrunkMeasures trunk = measures_of(tree_of_rows(width_px));
  EXPECT_EQ(trunk.width_px, 9);
  EXPECT_EQ(trunk.bare_px, 30);
  EXPECT_NEAR(trunk.stand_px, 12, 1);
}

TEST(TrunkMeasures, AFlaredTrunkIsMeasuredAboveItsFlare) {
  const TrunkMeasures trunk = measures_of(tree_of_rows([](int h) { return h < 30 ? 25 - h / 2 : 71; }));
  EXPECT_NEAR(trunk.width_px, 22, 2) << "not where it is thinnest, below the crown";
  EXPECT_EQ(trunk.foot_width_px, 25);
}

TEST(TrunkMeasures, ANarrowCrownBeginsHalfwayBetweenTrunkAndCrown) {
  const TrunkMeasures trunk = measures_of(tree_of_rows([](int h) { return h < 20 ? 21 : 41; }));
  EXPECT_EQ(trunk.bare_px, 20) << "although the crown is not 2.2 times as wide as the trunk";
}

TEST(TrunkMeasures, TiersOfAConiferAreNoWaist) {
  const auto width_px = [](int h) { return h < 2 ? 15 : h < 70 ? 81 - h : 41; };
  EXPECT_EQ(measures_of(tree_of_rows(width_px)).width_px, 15) << "and not 12, below the highest tier";
}

TEST(TrunkMeasures, TwigsThatHangDownBesideATrunkAreNoWaist) {
  Mask mask = tree_of_rows([](int h) { return h < 25 ? 5 : 101; });
  for (int h = 3; h < 25; ++h)
    for (const int beside : {-1, 1}) mask.set(64 + beside * (h < 7 ? 48 : 20), 105 - h);
  EXPECT_EQ(measures_of(mask).width_px, 5);
}

TEST(TrunkMeasures, ATrunkThatForksIntoRootsIsMeasuredAboveThem) {
  Mask mask = tree_of_rows([](int h) { return h < 8 ? 0 : h < 40 ? 15 : 71; });
  for (int h = 0; h < 8; ++h)
    for (const int left : {54, 70})
      for (int x = left; x < left + 5 - (h < 2 ? left / 20 : 0); ++x) mask.set(x, 105 - h);
  for (int x = 54; x < 75; ++x) mask.set(x, 105 - 8);
  const TrunkMeasures trunk = measures_of(mask);
  EXPECT_EQ(trunk.width_px, 15);
  EXPECT_EQ(trunk.bare_px, 40);
  EXPECT_EQ(trunk.foot_width_px, 21);
  EXPECT_EQ(trunk.stems, 1);
}

}  // namespace
}  // namespace espalier
