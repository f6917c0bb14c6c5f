// Trunks that fork into roots, drawn here row by row.
#include <gtest/gtest.h>

#include <espalier/image/reading/read_target.h>
#include <espalier/image/reading/roots.h>

namespace espalier {
namespace {

void set_box(int left, int right, int top, int bottom, Mask& mask) {
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x) mask.set(x, y);
}

/// 200 rows: a crown on a trunk of 12 pixels.
Mask tree() {
  Mask mask(160, 220);
  set_box(20, 140, 10, 100, mask);
  set_box(74, 86, 100, 210, mask);
  return mask;
}

/// The tree on feet of 8 pixels, the left one alone on the lowest rows.
Mask rooted_tree() {
  Mask mask = tree();
  for (int y = 196; y < 210; ++y) std::ranges::fill(mask.row(y), 0);
  set_box(67, 93, 192, 196, mask);
  set_box(67, 75, 196, 210, mask);
  set_box(85, 93, 196, 204, mask);
  return mask;
}

std::optional<Roots> roots_of_all(const Mask& mask) { return roots_of(mask, box_of(mask)); }

TEST(Roots, ATrunkOnTwoFeet) {
  const std::optional<Roots> roots = roots_of_all(rooted_tree());
  ASSERT_TRUE(roots);
  EXPECT_EQ(roots->fork_row, 196);
  EXPECT_EQ(roots->trunk.first, 74);
  EXPECT_EQ(roots->trunk.width(), 12);
  EXPECT_EQ(roots->width_px, 26);
}

TEST(Roots, OneFootHasNone) { EXPECT_FALSE(roots_of_all(tree())); }

TEST(Roots, AHoleInTheTrunkIsNoFork) {
  Mask mask = tree();
  for (int y = 192; y < 198; ++y)
    for (int x = 78; x < 82; ++x) mask.set(x, y, false);
  EXPECT_FALSE(roots_of_all(mask));
}

TEST(Roots, RoughGroundIsNoFork) {
  Mask mask = tree();
  set_box(60, 100, 200, 207, mask);
  for (const int left : {60, 70, 80, 90}) set_box(left, left + 6, 207, 210, mask);
  EXPECT_FALSE(roots_of_all(mask));
}

TEST(Roots, TrunksThatJoinFurtherUpAreNone) {
  Mask mask = tree();
  for (int y = 150; y < 210; ++y) std::ranges::fill(mask.row(y), 0);
  set_box(66, 74, 149, 210, mask);
  set_box(86, 94, 149, 210, mask);
  EXPECT_FALSE(roots_of_all(mask));
}

TEST(Roots, ACrownThatHangsDownToTheGroundIsNoTrunk) {
  Mask mask(160, 220);
  set_box(20, 140, 10, 200, mask);
  set_box(20, 60, 200, 210, mask);
  set_box(100, 140, 200, 210, mask);
  EXPECT_FALSE(roots_of_all(mask));
}

TEST(Roots, WithoutThemTheTrunkGoesStraightDown) {
  EXPECT_FALSE(roots_of_all(without_roots(rooted_tree())));
  const Mask straight = without_roots(rooted_tree());
  for (int y = 196; y < 210; ++y) EXPECT_EQ(runs_of(straight, y).size(), 1u) << y;
  EXPECT_EQ(widest_run(straight, 209).first, 74);
  EXPECT_EQ(widest_run(straight, 209).last, 85);
  EXPECT_EQ(without_roots(tree()), tree());
}

TEST(Roots, AFramedTreeStandsOnItsTrunkNotOnOneFoot) {
  const Mask framed = frame_mask(rooted_tree(), 128, "rooted").mask;
  const std::optional<Roots> roots = roots_of_all(framed);
  ASSERT_TRUE(roots);
  EXPECT_NEAR(roots->trunk.middle(), 64, 0.6);
}

}  // namespace
}  // namespace espalier
