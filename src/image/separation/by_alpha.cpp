#include <algorithm>
#include <cmath>

#include <espalier/core/error.h>
#include <espalier/image/masks/convex_hull.h>
#include <espalier/image/masks/mask_box.h>
#include <espalier/image/masks/morphology.h>
#include <espalier/image/separation/border_colors.h>
#include <espalier/image/separation/by_alpha.h>
#include <espalier/image/separation/ground.h>
#include <espalier/image/separation/mask_parts.h>

namespace espalier {

namespace {

constexpr float kOpaque = 0.5f, kWhollyOpaque = 0.95f;
constexpr double kConvex = 0.985;        ///< of its hull, that a card covers
constexpr double kGroundOfBorder = 0.6;  ///< of a card's border, that is like the ground beside it
constexpr double kLeastGround = 0.2, kLeastContent = 0.01;  ///< of a card, its ground and what is on it
constexpr double kLeastShadow = 0.01;                       ///< of what is opaque
constexpr float kShadowColors = 0.06f;                      ///< a shadow is of one colour
constexpr float kBlackAlpha = 0.02f;                        ///< less shows nothing

float alpha_of(const Rgba& rgba) { return rgba[3]; }

Mask opaque_part(const DecodedPicture& picture, float threshold) {
  return above(make_channel(picture, alpha_of), threshold);
}

/// A sheet with a picture on it: convex, of a smooth ground at its rim, and something else inside.
bool is_card(const DecodedPicture& picture, const Mask& opaque) {
  const auto area = static_cast<double>(area_px(opaque));
  if (area < kConvex * convex_hull_area_px(opaque)) return false;
  const BorderColors border = border_colors(picture, opaque);
  const Ground ground = find_ground(picture, opaque, border, {});
  if (ground.border_share < kGroundOfBorder) return false;
  const auto reached = static_cast<double>(area_px(ground.reached));
  return reached > kLeastGround * area && reached < (1 - kLeastContent) * area;
}

struct ShadowPixels {
  std::vector<float> alphas;
  std::array<std::vector<float>, 3> colors;
};

/// Half transparent pixels among others: not the edges of what is opaque.
ShadowPixels half_transparent_areas(const DecodedPicture& picture) {
  const auto is_half = [&](int x, int y) {
    const float alpha = picture.at(x, y)[3];
    return alpha > kOpaque / 2 && alpha < kWhollyOpaque;
  };
  ShadowPixels pixels;
  for (int y = 1; y + 1 < picture.height_px; ++y)
    for (int x = 1; x + 1 < picture.width_px; ++x) {
      if (!is_half(x, y) || !is_half(x - 1, y) || !is_half(x + 1, y) || !is_half(x, y - 1) ||
          !is_half(x, y + 1))
        continue;
      const Rgba& rgba = picture.at(x, y);
      pixels.alphas.push_back(rgba[3]);
      for (int c = 0; c < 3; ++c) pixels.colors[c].push_back(rgba[c] / rgba[3]);
    }
  return pixels;
}

/// Alpha of the drop shadow; 0 where there is none: half transparent areas of one colour beside what is
/// opaque.
float shadow_alpha(const DecodedPicture& picture) {
  ShadowPixels pixels = half_transparent_areas(picture);
  const auto opaque = static_cast<double>(area_px(opaque_part(picture, kWhollyOpaque)));
  const auto half = static_cast<double>(pixels.alphas.size());
  if (opaque == 0 || half < kLeastShadow * opaque || half > 3 * opaque) return 0;
  for (std::vector<float>& channel : pixels.colors)
    if (quantile(channel, 0.95) - quantile(channel, 0.05) > kShadowColors) return 0;
  const float alpha = quantile(pixels.alphas, 0.95);
  return alpha > kOpaque ? alpha : 0;
}

}  // namespace

AlphaReading read_alpha(const DecodedPicture& picture) {
  AlphaReading reading;
  if (!picture.has_alpha) return reading;
  reading.most = 0;
  for (const Rgba& rgba : picture.pixels) reading.most = std::max(reading.most, rgba[3]);
  reading.is_nothing = reading.most < kBlackAlpha;
  const Mask opaque = opaque_part(picture, kOpaque);
  const auto area = area_px(opaque);
  reading.informs =
      area > 0 && static_cast<double>(area) / static_cast<double>(picture.pixels.size()) < 0.995;
  if (!reading.informs) return reading;
  reading.outlines_card = is_card(picture, opaque);
  if (reading.outlines_card)
    reading.shown = erode_disc(opaque_part(picture, kWhollyOpaque), 1);
  else
    reading.shadow = shadow_alpha(picture);
  return reading;
}

Separation separate_by_alpha(const DecodedPicture& picture, const AlphaReading& reading,
                             const SeparationOptions& options) {
  const float threshold =
      reading.shadow > 0 ? reading.shadow + options.threshold * (1 - reading.shadow) : options.threshold;
  const Mask opaque = opaque_part(picture, threshold);
  const std::string shadow =
      reading.shadow > 0 ? fmt::format(", over its shadow of {:.2f}", reading.shadow) : "";
  if (options.side == TreeSide::dark)
    return {complement(opaque), fmt::format("alpha below {:.3g}", threshold)};
  return {opaque, fmt::format("alpha above {:.3g}{}", threshold, shadow)};
}

}  // namespace espalier
