#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <espalier/image/masks/mask_box.h>
#include <espalier/image/masks/morphology.h>
#include <espalier/image/separation/border_colors.h>
#include <espalier/image/separation/color_field.h>

namespace espalier {

namespace {

constexpr int kMostSectors = 1024;      ///< of the border, seen from the middle
constexpr double kWindow = 0.1;         ///< of the border: what is shorter than half of it is no ground
constexpr float kNearColor = 0.1f;      ///< of the colour that most of the border has
constexpr double kOneColorShare = 0.7;  ///< of the border, near one colour: the ground is of that colour
constexpr float kLeastTolerance = 0.04f, kMostTolerance = 0.12f;

/// The two outermost rings of what is shown, by the angle at which its middle sees them.
std::vector<PixelPlace> places_of_border(const Mask& shown) {
  const Mask inner = without(shown, [&] {
    Mask hidden = complement(shown), wider;
    for (int x = 0; x < shown.width_px(); ++x) hidden.set(x, 0), hidden.set(x, shown.height_px() - 1);
    for (int y = 0; y < shown.height_px(); ++y) hidden.set(0, y), hidden.set(shown.width_px() - 1, y);
    dilate_square(hidden, wider);
    return wider;
  }());
  std::vector<PixelPlace> places;
  for (int y = 0; y < shown.height_px(); ++y)
    for (int x = 0; x < shown.width_px(); ++x)
      if (shown.get(x, y) && !inner.get(x, y)) places.push_back({x, y});
  return places;
}

std::vector<std::vector<int>> sectors_of(const std::vector<PixelPlace>& places, const MaskBox& box) {
  const int count = std::clamp(static_cast<int>(places.size()) / 4, 1, kMostSectors);
  std::vector<std::vector<int>> sectors(count);
  const double middle_x = 0.5 * (box.left + box.right - 1), middle_y = 0.5 * (box.top + box.bottom - 1);
  for (int i = 0; i < static_cast<int>(places.size()); ++i) {
    // Of the box stretched to a square, so that each side has as many sectors as any.
    const double angle =
        std::atan2((places[i].y - middle_y) / box.height(), (places[i].x - middle_x) / box.width());
    const double turn = angle / (2 * std::numbers::pi) + 0.5;
    sectors[std::clamp(static_cast<int>(turn * count), 0, count - 1)].push_back(i);
  }
  return sectors;
}

ColorValue median_color(const std::vector<ColorValue>& colors, std::vector<float>& scratch) {
  ColorValue median{};
  for (int c = 0; c < 3; ++c) {
    scratch.clear();
    for (const ColorValue& color : colors) scratch.push_back(color[c]);
    median[c] = quantile(scratch, 0.5);
  }
  return median;
}

float median_distance(const std::vector<ColorValue>& colors, const ColorValue& from,
                      std::vector<float>& scratch) {
  scratch.clear();
  for (const ColorValue& color : colors) scratch.push_back(color_distance(color, from));
  return quantile(scratch, 0.5);
}

std::vector<ColorValue> median_colors(const std::vector<std::vector<int>>& sectors,
                                      const std::vector<ColorValue>& colors) {
  std::vector<ColorValue> medians, members;
  std::vector<float> scratch;
  for (const std::vector<int>& sector : sectors) {
    members.clear();
    for (const int i : sector) members.push_back(colors[i]);
    medians.push_back(median_color(members, scratch));
  }
  return medians;
}

/// Medians over the `reach` values on both sides of each, around a ring.
std::vector<float> running_medians(const std::vector<float>& ring, int reach) {
  const int count = static_cast<int>(ring.size());
  std::vector<float> medians(count), window;
  for (int s = 0; s < count; ++s) {
    window.clear();
    for (int i = -reach; i <= reach; ++i) window.push_back(ring[(s + i + count) % count]);
    medians[s] = quantile(window, 0.5);
  }
  return medians;
}

std::vector<ColorValue> running_medians(const std::vector<ColorValue>& ring, int reach) {
  std::vector<ColorValue> medians(ring.size());
  std::vector<float> channel(ring.size());
  for (int c = 0; c < 3; ++c) {
    for (std::size_t s = 0; s < ring.size(); ++s) channel[s] = ring[s][c];
    const std::vector<float> of_channel = running_medians(channel, reach);
    for (std::size_t s = 0; s < ring.size(); ++s) medians[s][c] = of_channel[s];
  }
  return medians;
}

void tell_one_color(const std::vector<ColorValue>& colors, BorderColors& border) {
  std::vector<float> distances;
  border.color = median_color(colors, distances);
  distances.clear();
  for (const ColorValue& color : colors) distances.push_back(color_distance(color, border.color));
  const auto near = std::count_if(distances.begin(), distances.end(), [](float d) { return d < kNearColor; });
  border.share = static_cast<double>(near) / static_cast<double>(distances.size());
  border.noise = quantile(distances, 0.9 * border.share);
}

}  // namespace

float BorderPlace::tolerance() const {
  return std::clamp(0.02f + 4 * noise, kLeastTolerance, kMostTolerance);
}

BorderColors border_colors(const DecodedPicture& picture, const Mask& shown) {
  BorderColors border;
  const std::vector<PixelPlace> places = places_of_border(shown);
  if (places.empty()) return border;
  std::vector<ColorValue> colors;
  colors.reserve(places.size());
  for (const PixelPlace& place : places) colors.push_back(color_of(picture.at(place.x, place.y)));
  tell_one_color(colors, border);
  std::vector<float> scratch;
  std::vector<std::vector<int>> sectors = sectors_of(places, box_of(shown));
  std::erase_if(sectors, [](const std::vector<int>& sector) { return sector.empty(); });
  const int count = static_cast<int>(sectors.size()),
            reach = border.share > kOneColorShare ? 0 : static_cast<int>(kWindow / 2 * count);
  std::vector<ColorValue> window;
  const std::vector<ColorValue> grounds = reach == 0 ? std::vector<ColorValue>(count, border.color)
                                                     : running_medians(median_colors(sectors, colors), reach);
  std::vector<float> noises(count, border.noise / 3);
  if (reach > 0) {
    for (int s = 0; s < count; ++s) {
      window.clear();
      for (const int i : sectors[s]) window.push_back(colors[i]);
      noises[s] = median_distance(window, grounds[s], scratch);
    }
    noises = running_medians(noises, reach / 2);
  }
  for (int s = 0; s < count; ++s)
    for (const int i : sectors[s]) border.places.push_back({places[i].x, places[i].y, grounds[s], noises[s]});
  return border;
}

}  // namespace espalier
