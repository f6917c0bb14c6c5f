// Colours and numbers given for each pixel of a picture, and smooth fields that are known in places only.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <espalier/image/masks/mask.h>
#include <espalier/image/pictures/decode.h>
#include <espalier/image/separation/separation_options.h>

namespace espalier {

/// One value a pixel, row by row.
struct Channel {
  int width_px = 0, height_px = 0;
  std::vector<float> values;

  float at(int x, int y) const { return values[static_cast<std::size_t>(y) * width_px + x]; }
  float& at(int x, int y) { return values[static_cast<std::size_t>(y) * width_px + x]; }
};

template <typename ValueOf>
Channel make_channel(const DecodedPicture& picture, ValueOf value_of) {
  Channel channel{picture.width_px, picture.height_px, {}};
  channel.values.reserve(picture.pixels.size());
  for (const Rgba& rgba : picture.pixels) channel.values.push_back(value_of(rgba));
  return channel;
}

/// The value that this share of the others, 0..1, do not exceed, rounded down to one of them; of at least one
/// value.
inline float quantile(std::vector<float>& values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

inline ColorValue color_of(const Rgba& rgba) { return {rgba[0], rgba[1], rgba[2]}; }

/// The largest difference of a channel.
inline float color_distance(const ColorValue& a, const ColorValue& b) {
  return std::max({std::fabs(a[0] - b[0]), std::fabs(a[1] - b[1]), std::fabs(a[2] - b[2])});
}

/// How far a colour is from all mixtures of two others.
inline float distance_from_mixtures(const ColorValue& color, const ColorValue& one, const ColorValue& other) {
  float along = 0, length = 0;
  for (int c = 0; c < 3; ++c) {
    along += (color[c] - one[c]) * (other[c] - one[c]);
    length += (other[c] - one[c]) * (other[c] - one[c]);
  }
  const float share = length > 0 ? std::clamp(along / length, 0.0f, 1.0f) : 0;
  ColorValue mixture;
  for (int c = 0; c < 3; ++c) mixture[c] = one[c] + share * (other[c] - one[c]);
  return color_distance(color, mixture);
}

/// A field over a picture in square cells, each with a weight: how much is known of it. Where nothing is
/// known, it is what is known nearby (Gortler et al., The Lumigraph, SIGGRAPH 1996, §3.4: pull and push).
class SmoothField {
 public:
  SmoothField(int width_px, int height_px, int cell_px);

  int cell_px() const { return cell_px_; }
  void add(int x, int y, const ColorValue& value, float weight = 1);
  /// Once all is added; false where nothing is known.
  bool fill();
  /// Linear between the middles of cells.
  ColorValue at(int x, int y) const;

 private:
  struct Level {
    int width = 0, height = 0;
    std::vector<std::array<float, 4>> cells;  ///< sums of three values and of their weights
  };

  static Level halved(const Level& fine);
  static void fill_from(const Level& coarse, Level& fine);

  int cell_px_;
  Level level_;
};

}  // namespace espalier
