// Laws of the labels: leaves and wood are told apart by the colours of this picture, whatever they are, and
// where the colours do not say, nothing is said.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

#include <espalier/image/masks/mask_box.h>
#include <espalier/image/reading/color_classes.h>
#include <espalier/image/reading/label_picture.h>
#include <espalier/image/reading/oklab.h>
#include <espalier/image/reading/plant_labels.h>

namespace espalier {
namespace {

using testing::HasSubstr;
using Color = Eigen::Vector3d;

constexpr int kSizePx = 120;

/// What a drawn tree shows: a trunk, a round crown on it, and two limbs that the crown does not hide.
enum class Part { ground, leaf, wood };

Part part_at(int x, int y) {
  const double u = (x + 0.5) / kSizePx - 0.5, v = (y + 0.5) / kSizePx;
  const bool limb = std::fabs(std::fabs(u) - (0.55 - v)) < 0.025 && v > 0.25 && v < 0.55;
  if (limb || (std::fabs(u) < 0.04 && v > 0.55 && v < 0.95)) return Part::wood;
  return std::hypot(u, v - 0.32) < 0.28 ? Part::leaf : Part::ground;
}

struct Drawing {
  DecodedPicture picture;
  Mask tree;
};

/// With leaves and wood of these colours (sRGB), give or take some noise.
Drawing draw(const Color& leaf, const Color& wood, double noise = 0.03) {
  Drawing drawing{{kSizePx, kSizePx, kSizePx, kSizePx, true, {}}, Mask(kSizePx, kSizePx)};
  for (int y = 0; y < kSizePx; ++y)
    for (int x = 0; x < kSizePx; ++x) {
      const Part part = part_at(x, y);
      Rgba pixel{0, 0, 0, 0};
      if (part != Part::ground) {
        const Color& color = part == Part::leaf ? leaf : wood;
        for (std::size_t i = 0; i < 3; ++i)
          pixel[i] = static_cast<float>(
              std::clamp(color[static_cast<Eigen::Index>(i)] +
                             noise * std::sin(12.9898 * x + 78.233 * y + 37.7 * static_cast<double>(i)),
                         0.0, 1.0));
        pixel[3] = 1;
        drawing.tree.set(x, y);
      }
      drawing.picture.pixels.push_back(pixel);
    }
  return drawing;
}

/// Share of the pixels of `part` that the mask holds.
double share_within(const Mask& mask, Part part) {
  double in = 0, all = 0;
  for (int y = 0; y < kSizePx; ++y)
    for (int x = 0; x < kSizePx; ++x)
      if (part_at(x, y) == part) {
        all += 1;
        in += mask.get(x, y);
      }
  return in / all;
}

const Color kBrown{0.35, 0.25, 0.16}, kGrey{0.45, 0.44, 0.42}, kGreen{0.25, 0.45, 0.12},
    kOrange{0.8, 0.4, 0.1}, kPurple{0.35, 0.08, 0.2}, kBlossom{0.95, 0.85, 0.9};

class Leaves : public testing::TestWithParam<std::pair<Color, Color>> {};

TEST_P(Leaves, AreToldFromWoodWhateverTheirColor) {
  const auto& [leaf, wood] = GetParam();
  const Drawing drawing = draw(leaf, wood);
  const PlantLabels labels = label_plant(drawing.picture, drawing.tree);
  ASSERT_TRUE(labels.are_known()) << labels.how;
  EXPECT_EQ(labels.px_per_label, 1);
  EXPECT_GT(share_within(labels.leaf, Part::leaf), 0.95);
  EXPECT_GT(share_within(labels.wood, Part::wood), 0.9) << "limbs too, not the trunk alone";
  EXPECT_LT(share_within(labels.leaf, Part::wood), 0.05);
  EXPECT_LT(share_within(labels.wood, Part::leaf), 0.02);
  EXPECT_EQ(share_within(labels.leaf, Part::ground) + share_within(labels.wood, Part::ground), 0);
  const auto all = static_cast<double>(area_px(drawing.tree));
  EXPECT_EQ(labels.leaf_share, static_cast<double>(area_px(labels.leaf)) / all);
  EXPECT_EQ(labels.wood_share, static_cast<double>(area_px(labels.wood)) / all);
}

INSTANTIATE_TEST_SUITE_P(Colors, Leaves,
                         testing::Values(std::pair(kGreen, kBrown), std::pair(kGreen, kGrey),
                                         std::pair(kOrange, kGrey), std::pair(kPurple, kGrey),
                                         std::pair(kBlossom, kBrown)));

TEST(PlantLabels, SayNothingWhereTheColorsDoNot) {
  const Color white{1, 1, 1};
  for (const auto& [leaf, wood] : {std::pair(white, white), std::pair(kBrown, kBrown),
                                   std::pair(kPurple, kPurple), std::pair(kGrey, kBrown)}) {
    const Drawing drawing = draw(leaf, wood, leaf == white ? 0 : 0.03);
    const PlantLabels labels = label_plant(drawing.picture, drawing.tree);
    EXPECT_FALSE(labels.are_known()) << leaf.transpose() << ": " << labels.how;
    EXPECT_THAT(labels.how, HasSubstr("do not tell"));
    EXPECT_EQ(area_px(labels.leaf) + area_px(labels.wood), 0u);
  }
}

TEST(PlantLabels, WithoutATrunkToCompareWithGreenIsLeaves) {
  const Drawing drawing = draw(kGreen, kGreen);
  const PlantLabels labels = label_plant(drawing.picture, drawing.tree);
  EXPECT_GT(labels.leaf_share, 0.95);
  EXPECT_EQ(labels.wood_share, 0);
  EXPECT_THAT(labels.how, HasSubstr("by their green"));
}

TEST(PlantLabels, BlackShadowsAreInDoubt) {
  Drawing drawing = draw(kGreen, {0.02, 0.02, 0.02}, 0.01);
  for (int y = 0; y < kSizePx; ++y)
    for (int x = 0; x < kSizePx; ++x)
      if (part_at(x, y) == Part::leaf && y % 2 == 0)
        drawing.picture.pixels[y * kSizePx + x] = {0.02f, 0.02f, 0.02f, 1};
  const PlantLabels labels = label_plant(drawing.picture, drawing.tree);
  EXPECT_LT(share_within(labels.leaf, Part::wood), 0.05);
  EXPECT_GT(share_within(labels.leaf, Part::leaf), 0.4);
}

TEST(PlantLabels, LargePicturesAreLabelledInBlocks) {
  const Drawing drawing = draw(kOrange, kGrey);
  DecodedPicture large{3 * kSizePx, 3 * kSizePx, 3 * kSizePx, 3 * kSizePx, true, {}};
  Mask tree(3 * kSizePx, 3 * kSizePx);
  for (int y = 0; y < 3 * kSizePx; ++y)
    for (int x = 0; x < 3 * kSizePx; ++x) {
      large.pixels.push_back(drawing.picture.at(x / 3, y / 3));
      tree.set(x, y, drawing.tree.get(x / 3, y / 3));
    }
  const PlantLabels labels = label_plant(large, tree);
  EXPECT_EQ(labels.px_per_label, 2);
  EXPECT_EQ(labels.leaf.width_px(), 3 * kSizePx / 2);
  EXPECT_NEAR(labels.leaf_share, label_plant(drawing.picture, drawing.tree).leaf_share, 0.05);
}

TEST(PlantLabels, TransparencyTakesNothingFromAColor) {
  Drawing drawing = draw(kGreen, kBrown);
  const PlantLabels opaque = label_plant(drawing.picture, drawing.tree);
  for (Rgba& pixel : drawing.picture.pixels)
    for (float& value : pixel) value *= 0.5f;  // premultiplied
  EXPECT_EQ(label_plant(drawing.picture, drawing.tree).leaf, opaque.leaf);
}

TEST(PlantLabels, TheirPictureIsGreenBrownAndGrey) {
  const Drawing drawing = draw(kOrange, kGrey);
  const PlantLabels labels = label_plant(drawing.picture, drawing.tree);
  const Picture picture = label_picture(drawing.tree, labels);
  for (int y = 0; y < kSizePx; ++y)
    for (int x = 0; x < kSizePx; ++x) {
      const Rgb expected = !drawing.tree.get(x, y) ? Rgb{255, 255, 255}
                           : labels.leaf.get(x, y) ? kLeafColor
                           : labels.wood.get(x, y) ? kWoodColor
                                                   : kDoubtColor;
      ASSERT_EQ(picture.at(x, y), expected);
    }
  EXPECT_EQ(label_picture(drawing.tree, {}).at(kSizePx / 2, kSizePx / 3), kDoubtColor);
}

TEST(Oklab, OfGreysHasNoChromaAndRisesWithTheirLightness) {
  double last = -1;
  for (const double grey : {0.0, 0.02, 0.2, 0.5, 1.0}) {
    const Color oklab = oklab_of({grey, grey, grey});
    EXPECT_NEAR(chroma_of(oklab), 0, 1e-6);
    EXPECT_GT(oklab[0], last);
    last = oklab[0];
  }
  EXPECT_NEAR(last, 1, 1e-6);
}

TEST(Oklab, OfThePrimariesIsThePublishedColor) {
  EXPECT_TRUE(oklab_of({1, 0, 0}).isApprox(Color(0.6279554, 0.2248631, 0.1258463), 1e-5));
  EXPECT_TRUE(oklab_of({0, 1, 0}).isApprox(Color(0.8664396, -0.2338874, 0.1794985), 1e-5));
  EXPECT_TRUE(oklab_of({0, 0, 1}).isApprox(Color(0.4520137, -0.0324570, -0.3115281), 1e-5));
}

TEST(ColorClasses, BhattacharyyasDistanceOfNormalDistributionsIsItsFormula) {
  ColorClass a{Color::Zero(), Eigen::Matrix3d::Identity(), 0};
  EXPECT_NEAR(bhattacharyya_distance(a, a), 0, 1e-12);
  ColorClass moved = a;
  moved.mean = {2, 0, 0};
  EXPECT_NEAR(bhattacharyya_distance(a, moved), 4.0 / 8, 1e-12);
  // Of variances 1 and 4 in each direction: ln(det 2.5 I / sqrt(1 · 64)) / 2.
  const ColorClass wide{Color::Zero(), Eigen::Matrix3d::Identity() / 4, std::log(64.0)};
  EXPECT_NEAR(bhattacharyya_distance(a, wide), 0.5 * std::log(15.625 / 8), 1e-12);
}

TEST(ColorClasses, AClassHasTheWeightedMeanAndCovariance) {
  const std::vector<Color> colors = {{0, 0, 0}, {1, 0, 0}, {9, 9, 9}};
  const std::vector<double> weights = {1, 3, 0};
  const ColorClass found = color_class_of(colors, weights);
  EXPECT_TRUE(found.mean.isApprox(Color(0.75, 0, 0)));
  const Eigen::Matrix3d covariance = found.inverse_covariance.inverse();
  EXPECT_NEAR(covariance(0, 0), 0.75 * 0.25, 1e-3);
  EXPECT_NEAR(covariance(1, 1), 0, 1e-3);
  EXPECT_NEAR(found.log_determinant, std::log(covariance.determinant()), 1e-9);
}

/// Expectation maximisation finds the share of a mixture whose one class is known.
TEST(ColorClasses, TheShareOfTheUnknownClassIsFound) {
  std::mt19937 random(7);
  const auto uniform = [&] { return random() / 4294967296.0; };
  const auto normal = [&](const Color& mean) {
    const auto noise = [&] { return 0.05 * (uniform() + uniform() + uniform() - 1.5); };
    return Color(mean + Color(noise(), noise(), noise()));
  };
  const Color known(0.3, 0.02, 0.04), other(0.2, -0.06, 0.08);
  std::vector<Color> sample, mixed;
  for (int i = 0; i < 200; ++i) sample.push_back(normal(known));
  for (int i = 0; i < 1000; ++i) mixed.push_back(normal(i < 300 ? known : other));
  const TwoClasses classes = split_colors(sample, mixed);
  EXPECT_NEAR(classes.share_of_other, 0.7, 0.03);
  EXPECT_LT((classes.other.mean - other).norm(), 0.01);
  EXPECT_LT((classes.known.mean - known).norm(), 0.01);
  EXPECT_GT(classes.other_probability(other), 0.95);
  EXPECT_LT(classes.other_probability(known), 0.05);
}

}  // namespace
}  // namespace espalier
