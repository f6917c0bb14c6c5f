// What stands beside a tree in a mask: found, left out, told, and kept where that is asked for.
#include <gtest/gtest.h>

#include <algorithm>

#include <espalier/image/marks/lines.h>
#include <espalier/image/marks/marks.h>

namespace espalier {
namespace {

constexpr int kWidth = 400, kHeight = 500, kFoot = 460;

void draw_box(Mask& mask, int left, int top, int right, int bottom) {
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x) mask.set(x, y);
}

/// A round crown on a trunk that stands on row kFoot.
Mask tree() {
  Mask mask(kWidth, kHeight);
  for (int y = 60; y < 300; ++y)
    for (int x = 80; x < 320; ++x)
      if ((x - 200) * (x - 200) + (y - 180) * (y - 180) < 118 * 118) mask.set(x, y);
  draw_box(mask, 190, 280, 210, kFoot);
  return mask;
}

MarkKind only_kind(const MarkedMask& marked) {
  EXPECT_EQ(marked.marks.size(), 1u);
  return marked.marks.empty() ? MarkKind::piece : marked.marks.front().kind;
}

TEST(Marks, ATreeAloneHasNone) {
  const MarkedMask marked = without_marks(tree(), {});
  EXPECT_EQ(marked.tree, tree());
  EXPECT_TRUE(marked.marks.empty());
}

TEST(Marks, AGroundLineIsTakenFromTheTrunkThatStandsOnIt) {
  Mask mask = tree();
  draw_box(mask, 0, kFoot, kWidth, kFoot + 2);
  const MarkedMask marked = without_marks(mask, {});
  EXPECT_EQ(only_kind(marked), MarkKind::line);
  EXPECT_EQ(marked.marks.front().box.width(), kWidth);
  EXPECT_LE(differing_px(marked.tree, tree()), 2u * 20) << "all but the line below the trunk";
}

TEST(Marks, AFrameIsLeftOut) {
  Mask mask = tree();
  draw_box(mask, 10, 10, 390, 12), draw_box(mask, 10, 488, 390, 490);
  draw_box(mask, 10, 10, 12, 490), draw_box(mask, 388, 10, 390, 490);
  const MarkedMask marked = without_marks(mask, {});
  EXPECT_EQ(only_kind(marked), MarkKind::frame);
  EXPECT_EQ(marked.tree, tree());
}

TEST(Marks, AThinTrunkIsNoLine) {
  Mask palm(kWidth, kHeight);
  draw_box(palm, 199, 100, 202, kFoot);
  draw_box(palm, 150, 60, 250, 100);
  EXPECT_EQ(without_marks(palm, {}).tree, palm);
}

TEST(Marks, ACaptionAndItsScaleBarAreLeftOutAndMeasured) {
  Mask mask = tree();
  for (int letter = 0; letter < 9; ++letter) draw_box(mask, 20 + 9 * letter, 20, 26 + 9 * letter, 29);
  draw_box(mask, 30, 480, 100, 483);
  const MarkedMask marked = without_marks(mask, {});
  EXPECT_EQ(marked.tree, tree());
  ASSERT_EQ(marked.marks.size(), 2u);
  const bool bar_first = marked.marks[0].kind == MarkKind::scale_bar;
  EXPECT_EQ(marked.marks[bar_first ? 0 : 1].box.width(), 70);
  EXPECT_EQ(marked.marks[bar_first ? 1 : 0].kind, MarkKind::caption);
  EXPECT_EQ(marked.marks[bar_first ? 1 : 0].parts, 9);
}

TEST(Marks, ABarJustBelowTheFootIsLeftOutWithItsLetters) {
  Mask mask = tree();
  draw_box(mask, 215, kFoot + 6, 285, kFoot + 8);
  draw_box(mask, 215, kFoot + 3, 217, kFoot + 11), draw_box(mask, 283, kFoot + 3, 285, kFoot + 11);
  draw_box(mask, 240, kFoot + 14, 246, kFoot + 22), draw_box(mask, 250, kFoot + 14, 256, kFoot + 22);
  const MarkedMask marked = without_marks(mask, {});
  ASSERT_EQ(marked.marks.size(), 2u);
  EXPECT_EQ(marked.marks[0].kind, MarkKind::scale_bar);
  EXPECT_EQ(marked.marks[0].box.width(), 70);
  EXPECT_EQ(marked.marks[1].kind, MarkKind::caption);
  EXPECT_EQ(marked.marks[1].parts, 2);
  EXPECT_EQ(marked.tree, tree());
  EXPECT_EQ(without_marks(mask, {.captions = false}).tree, mask);
}

TEST(Marks, ATrunkApartFromItsCrownStaysAsDoFallenLeaves) {
  Mask mask = tree();
  for (int y = 300; y < 304; ++y)
    for (int x = 0; x < kWidth; ++x) mask.set(x, y, false);
  draw_box(mask, 216, kFoot - 3, 222, kFoot);
  draw_box(mask, 226, kFoot + 2, 246, kFoot + 4);
  draw_box(mask, 262, 285, 312, 288);  // a loose twig below the crown
  EXPECT_EQ(without_marks(mask, {}).tree, mask);
}

TEST(Marks, AMoundBelowTheFootStays) {
  Mask mask = tree();
  draw_box(mask, 170, kFoot + 2, 230, kFoot + 14);
  EXPECT_EQ(without_marks(mask, {}).tree, mask);
}

TEST(Marks, APersonBesideTheTrunkIsAFigure) {
  Mask mask = tree();
  draw_box(mask, 330, kFoot - 80, 350, kFoot);
  const MarkedMask marked = without_marks(mask, {});
  EXPECT_EQ(only_kind(marked), MarkKind::figure);
  EXPECT_EQ(marked.tree, tree());
}

TEST(Marks, LooseLeavesWithinTheOutlineStay) {
  Mask mask(kWidth, kHeight);
  for (int y = 60; y < 300; y += 40)
    for (int x = 80; x < 320; x += 12) draw_box(mask, x, y, x + 10, y + 20);
  draw_box(mask, 190, 290, 210, kFoot);
  EXPECT_EQ(without_marks(mask, {}).tree, mask);
}

TEST(Marks, ASecondTreeIsNoMark) {
  Mask mask = tree();
  draw_box(mask, 350, 250, 395, kFoot);
  EXPECT_EQ(without_marks(mask, {}).tree, mask);
}

TEST(Marks, EachKindCanBeKept) {
  Mask lined = tree(), captioned = tree(), peopled = tree();
  draw_box(lined, 0, kFoot, kWidth, kFoot + 2);
  for (int letter = 0; letter < 9; ++letter) draw_box(captioned, 20 + 9 * letter, 20, 26 + 9 * letter, 29);
  draw_box(peopled, 330, kFoot - 80, 350, kFoot);
  EXPECT_EQ(without_marks(lined, {.lines = false}).tree, lined);
  EXPECT_EQ(without_marks(captioned, {.captions = false}).tree, captioned);
  EXPECT_EQ(without_marks(peopled, {.figures = false}).tree, peopled);
}

}  // namespace
}  // namespace espalier
