#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>

#include <espalier/core/random.h>
#include <espalier/image/masks/morphology.h>
#include <espalier/image/separation/border_colors.h>
#include <espalier/image/separation/coverage.h>
#include <espalier/image/separation/ground.h>
#include <espalier/image/separation/separate_tree.h>

namespace espalier {
namespace {

constexpr int kSidePx = 80;

using Paint = std::function<ColorValue(int, int)>;

DecodedPicture painted(const Paint& paint) {
  DecodedPicture picture;
  picture.width_px = picture.height_px = picture.source_width_px = picture.source_height_px = kSidePx;
  for (int y = 0; y < kSidePx; ++y)
    for (int x = 0; x < kSidePx; ++x) {
      const auto [red, green, blue] = paint(x, y);
      picture.pixels.push_back({red, green, blue, 1});
    }
  return picture;
}

ColorValue mixture(const ColorValue& ground, const ColorValue& tree, float share) {
  ColorValue mixed;
  for (int c = 0; c < 3; ++c) mixed[c] = ground[c] + share * (tree[c] - ground[c]);
  return mixed;
}

Coverage coverage_in(const DecodedPicture& picture, const std::optional<ColorValue>& tree_color = {}) {
  const Mask shown = complement(Mask(kSidePx, kSidePx));
  return coverage_of(picture, find_ground(picture, shown, border_colors(picture, shown), {}), tree_color);
}

bool is_in_square(int x, int y, int margin_px) {
  return x >= margin_px && y >= margin_px && x < kSidePx - margin_px && y < kSidePx - margin_px;
}

constexpr ColorValue kWhite{1, 1, 1}, kBlack{0, 0, 0}, kGrey{0.5f, 0.5f, 0.5f}, kLeaf{0.2f, 0.45f, 0.1f},
    kWood{0.35f, 0.22f, 0.12f};

/// A square of leaves whose rim, two pixels wide, is covered by a share.
DecodedPicture rimmed(const ColorValue& ground, const ColorValue& tree, float share) {
  return painted([&](int x, int y) {
    return mixture(ground, tree, is_in_square(x, y, 22) ? 1 : is_in_square(x, y, 20) ? share : 0.0f);
  });
}

TEST(Coverage, IsTheShareOfTheMixtureOnAnyGround) {
  for (const ColorValue& ground : {kWhite, kBlack, kGrey, ColorValue{0.6f, 0.7f, 0.9f}})
    for (const float share : {0.2f, 0.45f, 0.55f, 0.8f}) {
      const Coverage coverage = coverage_in(rimmed(ground, kLeaf, share));
      EXPECT_NEAR(coverage.share.at(20, 40), share, 0.01) << ground[2] << " " << share;
      EXPECT_EQ(coverage.share.at(40, 40), 1);
      EXPECT_EQ(coverage.share.at(5, 5), 0);
    }
}

TEST(Coverage, IsMeasuredAgainstTheColorThatTheCallerKnows) {
  // Twigs of one pixel: no part of the tree is solid.
  const DecodedPicture twigs = painted(
      [](int x, int) { return mixture(kWhite, kBlack, x % 5 == 2 && x > 10 && x < 70 ? 0.45f : 0.0f); });
  EXPECT_EQ(coverage_in(twigs).share.at(42, 40), 1);
  EXPECT_NEAR(coverage_in(twigs, kBlack).share.at(42, 40), 0.45, 1e-3);
}

TEST(Coverage, BesideATrunkIsMeasuredAgainstItsColor) {
  // Leaves of more contrast than the trunk fill the upper half.
  const DecodedPicture picture = painted([](int x, int y) {
    if (!is_in_square(x, y, 16)) return kGrey;
    if (y < 40) return kBlack;
    return mixture(kGrey, kWood, x < 17 || x >= 63 ? 0.55f : 1.0f);
  });
  EXPECT_NEAR(coverage_in(picture).share.at(16, 55), 0.55, 0.02);
}

/// Leaves of many colours, with a pixel of shade at (40, 40) and one beside the rim at (21, 40).
DecodedPicture shaded_crown(float shade) {
  const RandomKey key = root_key(1);
  return painted([=](int x, int y) {
    if (!is_in_square(x, y, 20)) return kWhite;
    if ((x == 40 || x == 21) && y == 40) return mixture(kWhite, kLeaf, shade);
    const float u = static_cast<float>(uniform_signed(key, 0, y * kSidePx + x));
    return u > 0 ? ColorValue{0.3f + 0.2f * u, 0.2f, 0.1f} : ColorValue{0.1f, 0.5f - 0.3f * u, 0.2f};
  });
}

TEST(Coverage, OfATexturedTreeIsWholeWhereAFaintPixelLiesDeepInIt) {
  const Coverage coverage = coverage_in(shaded_crown(0.25f));
  EXPECT_TRUE(coverage.is_textured);
  EXPECT_EQ(coverage.share.at(40, 40), 1);
  EXPECT_LT(coverage.share.at(21, 40), 0.5);  // one pixel off the ground it may be a gap
  EXPECT_LT(coverage_in(shaded_crown(0.06f)).share.at(40, 40), 0.5);
}

TEST(Coverage, OfDarkWoodBeforeBlackIsWhole) {
  const auto with_trunk = [&](const ColorValue& ground) {
    return painted([&, ground](int x, int y) {
      if (!is_in_square(x, y, 10)) return ground;
      if (y < 40) return ColorValue{0.43f, 0.55f, 0.0f};
      return x > 32 && x < 48 ? mixture(ground, {1, 0.64f, 0.21f}, 0.07f) : ground;
    });
  };
  EXPECT_EQ(coverage_in(with_trunk(kBlack)).share.at(40, 60), 1);
}

TEST(Coverage, OfAShadowIsItsDarkness) {
  const DecodedPicture picture = painted([](int x, int y) {
    if (is_in_square(x, y, 10) && y < 40) return kLeaf;
    return is_in_square(x, y, 10) && y > 50 ? mixture(kWhite, kBlack, 0.2f) : kWhite;
  });
  EXPECT_LT(coverage_in(picture).share.at(40, 60), 0.25);
}

TEST(Coverage, OfALitPixelWithinPlainLeavesIsWhole) {
  const DecodedPicture picture = painted([](int x, int y) {
    if (x == 40 && y == 40) return ColorValue{0.62f, 0.5f, 0.5f};
    return is_in_square(x, y, 20) ? kLeaf : kGrey;
  });
  const Coverage coverage = coverage_in(picture);
  EXPECT_FALSE(coverage.is_textured);
  EXPECT_EQ(coverage.share.at(40, 40), 1);
}

TEST(SeparateTree, LeavesAsLightAsTheGroundAreToldByTheirColor) {
  const DecodedPicture picture = painted([](int x, int y) {
    if (is_in_square(x, y, 16) && y < 40) return ColorValue{0.35f, 0.58f, 0.1f};
    return std::abs(x - 40) < 12 && y >= 40 && y < 70 ? kBlack : kGrey;
  });
  const Mask tree = separate_tree(picture, {}, "a.png").mask;
  EXPECT_TRUE(tree.get(40, 30));
  EXPECT_TRUE(tree.get(40, 60));
  EXPECT_FALSE(tree.get(10, 60));
}

TEST(Coverage, OfAMaskIsItsValue) {
  const Coverage coverage = coverage_in(rimmed(kBlack, kWhite, 0.3f));
  EXPECT_TRUE(coverage.is_soft);
  EXPECT_NEAR(coverage.share.at(20, 40), 0.3, 1e-6);
}

TEST(Coverage, IsZeroWhereNothingStandsOut) {
  const Coverage coverage = coverage_in(painted([](int, int) { return kGrey; }));
  for (const float share : coverage.share.values) EXPECT_EQ(share, 0);
}

}  // namespace
}  // namespace espalier
