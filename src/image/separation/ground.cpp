#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>

#include <espalier/image/separation/ground.h>

namespace espalier {

namespace {

constexpr int kMostCells = 256;  ///< of the interpolated ground, along the picture's larger side
constexpr int kSeamReach = 5;    ///< px: most that a soft horizon is high, to one side
constexpr float kSeedTolerance = 0.06f;
constexpr float kExact = 0.004f;  ///< noise of a ground that was drawn, not seen
constexpr float kLeastExactContrast = 0.015f, kLeastContrast = 0.03f, kMostContrast = 0.12f;

int larger_side(const DecodedPicture& picture) { return std::max(picture.width_px, picture.height_px); }

/// Pixels from which the ground grows, and how far it follows its colours.
struct Growth {
  const DecodedPicture& picture;
  const Mask& shown;
  float follow;  ///< share of a pixel's colour in what its neighbours are compared with
  std::vector<std::array<std::uint16_t, 3>> colors{};
  std::vector<std::uint8_t> tolerances{};
  Mask reached{};
  std::vector<std::uint32_t> front{}, next{};

  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * picture.width_px + x; }

  void reach(int x, int y, const ColorValue& expected, std::uint8_t tolerance) {
    const ColorValue color = color_of(picture.at(x, y));
    auto& kept = colors[index(x, y)];
    for (int c = 0; c < 3; ++c) {
      const float mixed = expected[c] + follow * (color[c] - expected[c]);
      kept[c] = static_cast<std::uint16_t>(std::lround(std::clamp(mixed, 0.0f, 1.0f) * 65535));
    }
    tolerances[index(x, y)] = tolerance;
    reached.set(x, y);
    next.push_back(static_cast<std::uint32_t>(index(x, y)));
  }

  void offer(int x, int y, const ColorValue& expected, std::uint8_t tolerance) {
    if (x < 0 || y < 0 || x >= picture.width_px || y >= picture.height_px) return;
    if (!shown.get(x, y) || reached.get(x, y)) return;
    if (color_distance(color_of(picture.at(x, y)), expected) * 255 > static_cast<float>(tolerance)) return;
    reach(x, y, expected, tolerance);
  }

  void grow() {
    while (!next.empty()) {
      front.swap(next);
      next.clear();
      for (const std::uint32_t at : front) {
        const int x = static_cast<int>(at % picture.width_px), y = static_cast<int>(at / picture.width_px);
        ColorValue expected;
        for (int c = 0; c < 3; ++c) expected[c] = static_cast<float>(colors[at][c]) / 65535;
        const std::uint8_t tolerance = tolerances[at];
        offer(x + 1, y, expected, tolerance);
        offer(x - 1, y, expected, tolerance);
        offer(x, y + 1, expected, tolerance);
        offer(x, y - 1, expected, tolerance);
      }
    }
  }
};

Growth make_growth(const DecodedPicture& picture, const Mask& shown) {
  Growth growth{picture, shown, std::clamp(20.0f / static_cast<float>(larger_side(picture)), 0.03f, 0.3f)};
  growth.colors.resize(picture.pixels.size());
  growth.tolerances.resize(picture.pixels.size());
  growth.reached.reset(picture.width_px, picture.height_px);
  return growth;
}

std::uint8_t as_byte(float tolerance) { return static_cast<std::uint8_t>(std::lround(tolerance * 255)); }

/// Its colours, without the pixels at its rim, which are half tree.
SmoothField field_of(const DecodedPicture& picture, const Mask& ground) {
  SmoothField field(picture.width_px, picture.height_px,
                    (larger_side(picture) + kMostCells - 1) / kMostCells);
  const auto is_inside = [&](int x, int y) {
    return ground.get(x, y) && (x == 0 || ground.get(x - 1, y)) && (y == 0 || ground.get(x, y - 1)) &&
           (x + 1 == picture.width_px || ground.get(x + 1, y)) &&
           (y + 1 == picture.height_px || ground.get(x, y + 1));
  };
  for (int y = 0; y < picture.height_px; ++y)
    for (int x = 0; x < picture.width_px; ++x)
      if (is_inside(x, y)) field.add(x, y, color_of(picture.at(x, y)));
  return field;
}

/// Where two grounds meet, as at a horizon, a few pixels are neither. The contrast of a pixel with mixtures
/// of the grounds nearest to it on two opposite sides, as far as `kSeamReach`.
float contrast_with_seam(const DecodedPicture& picture, const Mask& reached, int x, int y, float contrast) {
  const auto nearest = [&](int step_x, int step_y) -> const Rgba* {
    for (int i = 1; i <= kSeamReach; ++i) {
      const int u = x + i * step_x, v = y + i * step_y;
      if (u < 0 || v < 0 || u >= picture.width_px || v >= picture.height_px) return nullptr;
      if (reached.get(u, v)) return &picture.at(u, v);
    }
    return nullptr;
  };
  const ColorValue color = color_of(picture.at(x, y));
  for (const auto& [step_x, step_y] : {std::pair{0, 1}, {1, 0}}) {
    const Rgba *before = nearest(-step_x, -step_y), *after = nearest(step_x, step_y);
    if (before && after)
      contrast = std::min(contrast, distance_from_mixtures(color, color_of(*before), color_of(*after)));
  }
  return contrast;
}

/// Of a pixel that the ground reached: beside a horizon the interpolated colour is of both grounds, and a
/// little way off that of one.
float contrast_beside_seam(const DecodedPicture& picture, const Ground& ground, int x, int y,
                           float contrast) {
  const int away = 2 * ground.field->cell_px();
  const ColorValue color = color_of(picture.at(x, y));
  for (const auto& [u, v] : {std::pair{x, y - away}, {x, y + away}, {x - away, y}, {x + away, y}})
    if (u >= 0 && v >= 0 && u < picture.width_px && v < picture.height_px)
      contrast = std::min(contrast, color_distance(color, ground.color_at(u, v)));
  return contrast;
}

Channel contrast_with(const DecodedPicture& picture, const Mask& shown, const Ground& ground) {
  Channel contrast{picture.width_px, picture.height_px, std::vector<float>(picture.pixels.size())};
  for (int y = 0; y < picture.height_px; ++y)
    for (int x = 0; x < picture.width_px; ++x)
      if (shown.get(x, y))
        contrast.at(x, y) = color_distance(color_of(picture.at(x, y)), ground.color_at(x, y));
  if (!ground.field) return contrast;
  for (int y = 0; y < picture.height_px; ++y)
    for (int x = 0; x < picture.width_px; ++x)
      if (shown.get(x, y) && contrast.at(x, y) > kLeastExactContrast) {
        float& value = contrast.at(x, y);
        value = ground.reached.get(x, y) ? contrast_beside_seam(picture, ground, x, y, value)
                                         : contrast_with_seam(picture, ground.reached, x, y, value);
      }
  return contrast;
}

/// Three times what most of the ground differs from itself.
float tolerance_of(const Ground& ground) {
  std::vector<float> noise;
  for (int y = 0; y < ground.contrast.height_px; ++y)
    for (int x = 0; x < ground.contrast.width_px; ++x)
      if (ground.reached.get(x, y)) noise.push_back(ground.contrast.at(x, y));
  if (noise.empty()) return kLeastContrast;
  const float most = quantile(noise, 0.9);
  return most < kExact ? kLeastExactContrast : std::clamp(3 * most, kLeastContrast, kMostContrast);
}

/// Seeds that a user names grow with the colour that they have.
void seed_by_hand(const std::vector<PixelPlace>& seeds, Growth& growth) {
  for (const PixelPlace& seed : seeds)
    if (!growth.reached.get(seed.x, seed.y) && growth.shown.get(seed.x, seed.y))
      growth.reach(seed.x, seed.y, color_of(growth.picture.at(seed.x, seed.y)), as_byte(kSeedTolerance));
}

Mask claimed_by_tree(const DecodedPicture& picture, const Mask& shown, const SeparationOptions& options) {
  if (options.tree_seeds.empty()) return Mask(picture.width_px, picture.height_px);
  Growth growth = make_growth(picture, shown);
  seed_by_hand(options.tree_seeds, growth);
  growth.grow();
  return growth.reached;
}

}  // namespace

Ground find_ground(const DecodedPicture& picture, const Mask& shown, const BorderColors& border,
                   const SeparationOptions& options) {
  const Mask claimed = claimed_by_tree(picture, shown, options);
  const Mask free = without(shown, claimed);
  Growth growth = make_growth(picture, free);
  std::size_t like_ground = 0;
  for (const BorderPlace& place : border.places) {
    const ColorValue expected = options.ground_color.value_or(place.ground);
    const std::uint8_t tolerance = as_byte(place.tolerance());
    const std::size_t before = growth.next.size();
    growth.offer(place.x, place.y, expected, tolerance);
    like_ground += growth.next.size() - before;
  }
  seed_by_hand(options.ground_seeds, growth);
  growth.grow();
  Ground ground;
  ground.border_share = border.places.empty()
                            ? 0
                            : static_cast<double>(like_ground) / static_cast<double>(border.places.size());
  ground.reached = std::move(growth.reached);
  ground.claimed = claimed;
  SmoothField field = field_of(picture, ground.reached);
  const bool is_one_color = border.share > 0.9 && border.noise < kExact && options.ground_seeds.empty();
  if (options.ground_color || is_one_color || !field.fill())
    ground.color = options.ground_color.value_or(border.color);
  else
    ground.field = std::move(field);
  ground.contrast = contrast_with(picture, shown, ground);
  ground.tolerance = tolerance_of(ground);
  return ground;
}

}  // namespace espalier
