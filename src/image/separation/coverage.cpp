#include <algorithm>
#include <vector>

#include <espalier/image/separation/coverage.h>
#include <espalier/image/separation/mask_parts.h>

namespace espalier {

namespace {

constexpr float kFlat = 0.04f,
                kFlatShare = 0.1f;  ///< most that a plateau's pixels differ, and of their contrast
constexpr int kLeastPlateauPx = 50;
constexpr float kFaintPlateau = 0.25f, kFullPlateau = 0.8f;  ///< of the tree's contrast
constexpr float kOffMixture = 0.05f;     ///< from the line between two colours: no mixture of them
constexpr float kTexturedShare = 0.25f;  ///< of pixels within the tree, off that line
constexpr float kFaintBeforeBlack = 0.03f, kOffBeforeBlack = 0.15f;
constexpr int kDeepPx = 3;  ///< off the ground: deep in the tree
/// Of the contrast of a textured tree, shows one deep in it, 2 px and 1 px off the ground.
constexpr float kDeepFaint = 0.1f, kFaintNearGround = 0.3f, kFaintBesideGround = 0.4f;
constexpr int kPlateauReach = 2;  ///< px: width of a soft edge
constexpr float kBlack = 0.1f, kSoftContrast = 0.85f, kGrey = 0.02f;

float median_of(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The extreme value within `reach_px` pixels, along rows and then columns.
template <typename Choose>
Channel local_extreme(const Channel& channel, int reach_px, Choose choose) {
  Channel rows = channel, result = channel;
  for (int y = 0; y < channel.height_px; ++y)
    for (int x = 0; x < channel.width_px; ++x)
      for (int i = std::max(0, x - reach_px); i <= std::min(channel.width_px - 1, x + reach_px); ++i)
        rows.at(x, y) = choose(rows.at(x, y), channel.at(i, y));
  result = rows;
  for (int y = 0; y < channel.height_px; ++y)
    for (int j = std::max(0, y - reach_px); j <= std::min(channel.height_px - 1, y + reach_px); ++j)
      for (int x = 0; x < channel.width_px; ++x) result.at(x, y) = choose(result.at(x, y), rows.at(x, j));
  return result;
}

Channel local_maximum(const Channel& channel, int reach_px) {
  return local_extreme(channel, reach_px, [](float a, float b) { return std::max(a, b); });
}

Channel local_minimum(const Channel& channel, int reach_px) {
  return local_extreme(channel, reach_px, [](float a, float b) { return std::min(a, b); });
}

/// The pixels of which the tree's colours are taken.
struct Plateaus {
  Channel least;       ///< contrast within a pixel
  Mask flat;           ///< what surrounds the pixel is like it
  ColorValue color{};  ///< median
  bool found = false;
};

ColorValue median_color(const DecodedPicture& picture, const Channel& contrast, auto is_sample) {
  std::array<std::vector<float>, 3> values;
  for (int y = 0; y < picture.height_px; ++y)
    for (int x = 0; x < picture.width_px; ++x)
      if (is_sample(x, y, contrast.at(x, y)))
        for (int c = 0; c < 3; ++c) values[c].push_back(picture.at(x, y)[c]);
  ColorValue color{};
  if (values[0].empty()) return color;
  for (int c = 0; c < 3; ++c) color[c] = median_of(values[c]);
  return color;
}

/// What stands out most, for trees of which no part is solid.
float strong_contrast(const Channel& contrast, float noise) {
  std::vector<float> values;
  for (const float value : contrast.values)
    if (value > noise) values.push_back(value);
  if (values.empty()) return 0;
  return quantile(values, 0.9);
}

Plateaus find_plateaus(const DecodedPicture& picture, const Ground& ground) {
  const Channel& contrast = ground.contrast;
  const Channel most = local_maximum(contrast, 1);
  Plateaus plateaus{local_minimum(contrast, 1), Mask(contrast.width_px, contrast.height_px)};
  std::size_t count = 0;
  for (int y = 0; y < contrast.height_px; ++y)
    for (int x = 0; x < contrast.width_px; ++x) {
      const float upper = most.at(x, y), lower = plateaus.least.at(x, y);
      const float allowed = std::max(kFlat, kFlatShare * upper) + 0.5f * ground.tolerance;
      if (lower <= ground.tolerance || upper - lower >= allowed) continue;
      plateaus.flat.set(x, y);
      ++count;
    }
  const bool enough = count > kLeastPlateauPx;
  const float strong = enough ? 0 : strong_contrast(contrast, ground.tolerance);
  plateaus.found = enough || strong > 0;
  plateaus.color = median_color(picture, contrast, [&](int x, int y, float value) {
    return enough ? plateaus.flat.get(x, y) : strong > 0 && value >= strong;
  });
  return plateaus;
}

bool is_grey(const DecodedPicture& picture) {
  return std::all_of(picture.pixels.begin(), picture.pixels.end(), [](const Rgba& rgba) {
    return std::max({rgba[0], rgba[1], rgba[2]}) - std::min({rgba[0], rgba[1], rgba[2]}) < kGrey;
  });
}

/// What the tree's colour is measured against at each pixel.
struct Measures {
  Channel full;      ///< contrast of the tree's colour with the ground there
  Channel plateaus;  ///< contrast of plateaus that are tree, 0 elsewhere
  Mask off;          ///< pixels that are no mixtures of the ground's colour with the tree's, and no shadow
  double off_share = 0;  ///< of those within the tree
};

Measures measure(const DecodedPicture& picture, const Ground& ground, const Plateaus& plateaus,
                 const ColorValue& tree) {
  const int width = picture.width_px, height = picture.height_px;
  Measures measures{{width, height, std::vector<float>(picture.pixels.size())},
                    {width, height, std::vector<float>(picture.pixels.size())},
                    Mask(width, height)};
  double within = 0, off = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float contrast = ground.contrast.at(x, y);
      if (contrast <= ground.tolerance) continue;
      const ColorValue behind = ground.color_at(x, y), color = color_of(picture.at(x, y));
      const float full = color_distance(tree, behind);
      measures.full.at(x, y) = full;
      const float apart = distance_from_mixtures(color, behind, tree);
      const bool is_off = std::min(apart, distance_from_mixtures(color, behind, {})) > kOffMixture;
      measures.off.set(x, y, is_off);
      if (plateaus.least.at(x, y) > ground.tolerance) within += 1, off += is_off;
      const bool is_black = color_distance(behind, {}) < kBlack;  // on which nothing casts a shadow
      const float faint = is_black ? kFaintBeforeBlack : kFaintPlateau * full;
      const float off_mixture = is_black ? std::min(kOffMixture, kOffBeforeBlack * contrast) : kOffMixture;
      const bool is_tree = contrast > faint && (contrast > kFullPlateau * full || apart > off_mixture);
      if (plateaus.flat.get(x, y) && is_tree) measures.plateaus.at(x, y) = contrast;
    }
  measures.off_share = within == 0 ? 0 : off / within;
  return measures;
}

/// What lies within the tree, by how far off the ground is: shade and lit leaves look like gaps there.
class Within {
 public:
  explicit Within(const Ground& ground) {
    for (int px = 1; px <= kDeepPx; ++px)
      away_.push_back(above(local_minimum(ground.contrast, px), ground.tolerance));
  }

  /// `full`: contrast of the tree's colour with the ground.
  bool holds(int x, int y, float contrast, float full) const {
    if (!away_[0].get(x, y)) return false;
    if (away_[kDeepPx - 1].get(x, y)) return contrast > kDeepFaint * full;
    return contrast > (away_[1].get(x, y) ? kFaintNearGround : kFaintBesideGround) * full;
  }

 private:
  std::vector<Mask> away_;  ///< 1, 2, … px off all ground
};

float share_of(float contrast, float full) { return full > 0 ? std::min(1.0f, contrast / full) : 0; }

}  // namespace

Coverage coverage_of(const DecodedPicture& picture, const Ground& ground,
                     const std::optional<ColorValue>& tree_color) {
  const int width = picture.width_px, height = picture.height_px;
  Coverage coverage{.share = {width, height, std::vector<float>(picture.pixels.size())}};
  const Plateaus plateaus = find_plateaus(picture, ground);
  if (!plateaus.found && !tree_color) return coverage;
  ColorValue tree = tree_color.value_or(plateaus.color);
  const ColorValue behind = ground.color_at(width / 2, height / 2);
  const float most = color_distance(behind, tree);
  coverage.is_soft =
      !tree_color && color_distance(behind, {}) < kBlack && most > kSoftContrast && is_grey(picture);
  if (coverage.is_soft) {
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
      coverage.share.values[i] = ground.contrast.values[i] > 0 ? std::min(1.0f, picture.pixels[i][0]) : 0;
    return coverage;
  }
  const Measures measures = measure(picture, ground, plateaus, tree);
  coverage.is_textured = measures.off_share > kTexturedShare;
  const Within within(ground);
  const Channel nearby = local_maximum(measures.plateaus, kPlateauReach);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float contrast = ground.contrast.at(x, y);
      const bool is_within = (coverage.is_textured || measures.off.get(x, y)) &&
                             within.holds(x, y, contrast, measures.full.at(x, y));
      const float full = nearby.at(x, y) > 0 ? nearby.at(x, y) : measures.full.at(x, y);
      coverage.share.at(x, y) = is_within || measures.plateaus.at(x, y) > 0 ? 1 : share_of(contrast, full);
    }
  return coverage;
}

}  // namespace espalier
