#include <gtest/gtest.h>

#include <espalier/image/masks/pieces.h>

namespace espalier {
namespace {

void draw_square(Mask& mask, int first, int end) {
  for (int y = first; y < end; ++y)
    for (int x = first; x < end; ++x) mask.set(x, y);
}

TEST(Pieces, AreAllThatIsSetOnceTheLargestFirst) {
  Mask mask(64, 64), again(64, 64);
  draw_square(mask, 2, 6), draw_square(mask, 6, 8);  // joined by a corner
  draw_square(mask, 20, 60);
  const std::vector<MaskPiece> pieces = pieces_of(mask);
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_EQ(pieces[0].area_px, 1600u);
  EXPECT_EQ(pieces[1].area_px, 20u);
  EXPECT_EQ(pieces[1].box.right, 8);
  for (const MaskPiece& piece : pieces) set_pixels(piece, again);
  EXPECT_EQ(again, mask);
}

TEST(Pieces, ThatTouchByACornerAreTwoWhereFourNeighboursCount) {
  Mask mask(16, 16);
  draw_square(mask, 2, 6), draw_square(mask, 6, 8);
  EXPECT_EQ(pieces_of(mask, Connectivity::four).size(), 2u);
}

}  // namespace
}  // namespace espalier
