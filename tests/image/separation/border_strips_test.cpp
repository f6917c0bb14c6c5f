#include <gtest/gtest.h>

#include <cstdlib>

#include <espalier/image/separation/border_strips.h>

namespace espalier {
namespace {

constexpr int kWidthPx = 120, kHeightPx = 90;

/// A disc on white, and strips of a tone along the edges.
DecodedPicture with_strips(const BorderStrips& strips, float tone) {
  DecodedPicture picture;
  picture.width_px = picture.source_width_px = kWidthPx;
  picture.height_px = picture.source_height_px = kHeightPx;
  for (int y = 0; y < kHeightPx; ++y)
    for (int x = 0; x < kWidthPx; ++x) {
      const bool is_strip =
          x < strips.left || y < strips.top || x >= kWidthPx - strips.right || y >= kHeightPx - strips.bottom;
      const bool is_tree = (x - 60) * (x - 60) + (y - 45) * (y - 45) < 20 * 20;
      const float value = is_strip ? tone : is_tree ? 0.2f : 1.0f;
      picture.pixels.push_back({value, value, value, 1});
    }
  return picture;
}

TEST(BorderStrips, AreFoundOnEachEdgeAlone) {
  for (int edge = 0; edge < 4; ++edge) {
    BorderStrips drawn;
    int* const widths[] = {&drawn.left, &drawn.right, &drawn.top, &drawn.bottom};
    *widths[edge] = 5;
    const BorderStrips found = find_border_strips(with_strips(drawn, 0));
    EXPECT_EQ(found.left > 0, edge == 0) << edge;
    EXPECT_EQ(found.right > 0, edge == 1) << edge;
    EXPECT_EQ(found.top > 0, edge == 2) << edge;
    EXPECT_EQ(found.bottom > 0, edge == 3) << edge;
    const int width = found.left + found.right + found.top + found.bottom;
    EXPECT_GE(width, 5);
    EXPECT_LE(width, 7);  // and the soft edge between
  }
}

TEST(BorderStrips, APlainPictureHasNone) { EXPECT_FALSE(find_border_strips(with_strips({}, 0)).any()); }

TEST(BorderStrips, AGroundBelowIsNoStrip) {
  DecodedPicture picture = with_strips({}, 0);
  for (int x = 0; x < kWidthPx; ++x)  // hills, not a straight line
    for (int y = 60 + std::abs(x - 60) / 3; y < kHeightPx; ++y)
      picture.pixels[static_cast<std::size_t>(y) * kWidthPx + x] = {0.1f, 0.3f, 0.1f, 1};
  EXPECT_FALSE(find_border_strips(picture).any());
}

TEST(BorderStrips, AreToldBySide) {
  EXPECT_EQ(describe({.left = 20, .top = 12}), "border strips: 20 px left, 12 px above");
}

}  // namespace
}  // namespace espalier
