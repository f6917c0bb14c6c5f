#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <vector>

#include <espalier/image/masks/mask_box.h>
#include <espalier/image/masks/row_runs.h>
#include <espalier/image/reading/color_classes.h>
#include <espalier/image/reading/oklab.h>
#include <espalier/image/reading/plant_labels.h>

namespace espalier {

namespace {

using Color = Eigen::Vector3d;

constexpr int kMostSidePx = 256;  ///< of the picture that is labelled: textures are averaged, twigs are not
constexpr double kTrunkWidth = 0.22;  ///< of the tree's width: a row this narrow, near the foot, is trunk
constexpr int kLeastTrunkPx = 30;
constexpr double kSure = 0.8;  ///< probability of a label

/// The limits are where 24 coloured pictures of trees, bare and in leaf, fall apart (docs/labels.md).
constexpr double kLeastDistance = 0.9;      ///< Bhattacharyya's, of leaves and wood
constexpr double kLeastTrunkShare = 0.6;    ///< of the trunk, that is to be labelled wood
constexpr double kLeastChroma = 0.055;      ///< of leaves; twigs are greyer
constexpr double kBlossomLightness = 0.25;  ///< or they are this much lighter than the trunk, as blossom is
constexpr double kGreenHue = -0.015, kGreenChroma = 0.04, kLeastGreenShare = 0.35;

/// The picture in blocks, and what of it shows the tree.
struct Blocks {
  int px_per_block = 1;
  Mask tree;
  std::vector<Color> colors;  ///< row by row; zero outside of the tree

  const Color& at(int x, int y) const { return colors[static_cast<std::size_t>(y) * tree.width_px() + x]; }
};

/// Mean colour of the tree's pixels in a block, without what shines through; nothing where they are less than
/// half of it.
std::optional<Color> color_of_block(const DecodedPicture& picture, const Mask& tree, int left, int top,
                                    int side_px) {
  const int right = std::min(left + side_px, picture.width_px),
            bottom = std::min(top + side_px, picture.height_px);
  Color sum = Color::Zero();
  double cover = 0, count = 0;
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x) {
      if (!tree.get(x, y)) continue;
      const Rgba& pixel = picture.at(x, y);
      sum += Color(pixel[0], pixel[1], pixel[2]);
      cover += pixel[3];
      count += 1;
    }
  if (count < 0.5 * side_px * side_px || cover <= 0) return std::nullopt;
  return (sum / cover).cwiseMax(0).cwiseMin(1);
}

Blocks blocks_of(const DecodedPicture& picture, const Mask& tree) {
  const int side_px = (std::max(picture.width_px, picture.height_px) + kMostSidePx - 1) / kMostSidePx;
  Blocks blocks{.px_per_block = side_px};
  blocks.tree.reset((picture.width_px + side_px - 1) / side_px, (picture.height_px + side_px - 1) / side_px);
  for (int y = 0; y < blocks.tree.height_px(); ++y)
    for (int x = 0; x < blocks.tree.width_px(); ++x) {
      const auto color = color_of_block(picture, tree, x * side_px, y * side_px, side_px);
      blocks.tree.set(x, y, color.has_value());
      blocks.colors.push_back(color ? oklab_of(*color) : Color::Zero());
    }
  return blocks;
}

/// The first row of the trunk: from the foot up to where the tree becomes wide.
int crown_base_row(const Mask& tree, const MaskBox& box) {
  int row = box.bottom;
  while (row > box.top && row_extent_px(tree, row - 1) <= kTrunkWidth * box.width()) --row;
  return row;
}

/// Lightness counts half: the sun makes more of it than the plant does.
Color weighed(const Color& oklab) { return {0.5 * oklab[0], oklab[1], oklab[2]}; }

std::vector<Color> colors_of_rows(const Blocks& blocks, int top, int bottom) {
  std::vector<Color> colors;
  for (int y = top; y < bottom; ++y)
    for (int x = 0; x < blocks.tree.width_px(); ++x)
      if (blocks.tree.get(x, y)) colors.push_back(weighed(blocks.at(x, y)));
  return colors;
}

/// Of colours, at least one.
double share_of_leaves(const TwoClasses& classes, const std::vector<Color>& colors) {
  double sum = 0;
  for (const Color& color : colors) sum += classes.other_probability(color) > 0.5;
  return sum / static_cast<double>(colors.size());
}

bool could_be_leaves(const Color& leaf, const Color& wood) {
  return chroma_of(leaf) >= kLeastChroma || 2 * (leaf[0] - wood[0]) >= kBlossomLightness;
}

/// The classes that the trunk and the crown show; nothing where they are alike.
std::optional<TwoClasses> classes_of(const Blocks& blocks) {
  const MaskBox box = box_of(blocks.tree);
  const int base = crown_base_row(blocks.tree, box);
  const std::vector<Color> trunk = colors_of_rows(blocks, base, box.bottom),
                           crown = colors_of_rows(blocks, box.top, base);
  if (trunk.size() < kLeastTrunkPx || crown.empty()) return std::nullopt;
  const TwoClasses classes = split_colors(trunk, crown);
  const bool apart = bhattacharyya_distance(classes.known, classes.other) >= kLeastDistance &&
                     1 - share_of_leaves(classes, trunk) >= kLeastTrunkShare;
  if (!apart || !could_be_leaves(classes.other.mean, classes.known.mean)) return std::nullopt;
  return classes;
}

/// Labels each block by the probability that it shows leaves.
template <class Probability>
PlantLabels label_blocks(const Blocks& blocks, Probability leaf_probability) {
  const int width = blocks.tree.width_px(), height = blocks.tree.height_px();
  PlantLabels labels{
      .leaf = Mask(width, height), .wood = Mask(width, height), .px_per_label = blocks.px_per_block};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (!blocks.tree.get(x, y)) continue;
      const double probability = leaf_probability(blocks.at(x, y));
      labels.leaf.set(x, y, probability >= kSure);
      labels.wood.set(x, y, probability <= 1 - kSure);
    }
  const auto all = static_cast<double>(area_px(blocks.tree));
  labels.leaf_share = static_cast<double>(area_px(labels.leaf)) / all;
  labels.wood_share = static_cast<double>(area_px(labels.wood)) / all;
  return labels;
}

PlantLabels label_green(const Blocks& blocks) {
  return label_blocks(blocks, [](const Color& oklab) {
    return oklab[1] <= kGreenHue && chroma_of(oklab) >= kGreenChroma ? 1.0 : 0.5;
  });
}

std::string shares_of(const PlantLabels& labels) {
  return fmt::format("{:.0f} % leaf, {:.0f} % wood, {:.0f} % in doubt", 100 * labels.leaf_share,
                     100 * labels.wood_share, 100 * (1 - labels.leaf_share - labels.wood_share));
}

}  // namespace

PlantLabels label_plant(const DecodedPicture& picture, const Mask& tree) {
  const Blocks blocks = blocks_of(picture, tree);
  if (area_px(blocks.tree) == 0) return {.how = "too thin for its colours to be told"};
  if (const auto classes = classes_of(blocks)) {
    PlantLabels labels =
        label_blocks(blocks, [&](const Color& oklab) { return classes->other_probability(weighed(oklab)); });
    labels.how = fmt::format("leaves and wood by colour: {}", shares_of(labels));
    return labels;
  }
  PlantLabels labels = label_green(blocks);
  if (labels.leaf_share >= kLeastGreenShare) {
    labels.how = fmt::format("leaves by their green, no trunk to compare with: {}", shares_of(labels));
    return labels;
  }
  return {.how = "the colours do not tell leaves from wood"};
}

}  // namespace espalier
