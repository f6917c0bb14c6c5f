#include <algorithm>
#include <cmath>

#include <espalier/core/error.h>
#include <espalier/image/reading/separate_tree.h>

namespace espalier {

namespace {

constexpr int kBins = 256;
constexpr float kSmallestContrast = 0.02f;  ///< between the tones of tree and background, of the range 0..1

/// One value a pixel, row by row.
struct Channel {
  int width_px = 0, height_px = 0;
  std::vector<float> values;

  float at(int x, int y) const { return values[static_cast<std::size_t>(y) * width_px + x]; }
};

template <typename ValueOf>
Channel make_channel(const DecodedPicture& picture, ValueOf value_of) {
  Channel channel{picture.width_px, picture.height_px, {}};
  channel.values.reserve(picture.pixels.size());
  for (const Rgba& rgba : picture.pixels) channel.values.push_back(value_of(rgba));
  return channel;
}

/// Calls visit(x, y) for each pixel of the outermost ring once.
template <typename Visit>
void visit_border(int width_px, int height_px, Visit visit) {
  for (int x = 0; x < width_px; ++x) {
    visit(x, 0);
    visit(x, height_px - 1);
  }
  for (int y = 1; y < height_px - 1; ++y) {
    visit(0, y);
    visit(width_px - 1, y);
  }
}

Mask above(const Channel& channel, float threshold) {
  Mask mask(channel.width_px, channel.height_px);
  for (int y = 0; y < channel.height_px; ++y)
    for (int x = 0; x < channel.width_px; ++x) mask.set(x, y, channel.at(x, y) > threshold);
  return mask;
}

Mask inverse(const Mask& mask) {
  Mask result(mask.width_px(), mask.height_px());
  for (int y = 0; y < mask.height_px(); ++y)
    for (int x = 0; x < mask.width_px(); ++x) result.set(x, y, !mask.get(x, y));
  return result;
}

/// Whether most of the border is set.
bool border_is_set(const Mask& mask) {
  long set = 0, all = 0;
  visit_border(mask.width_px(), mask.height_px(), [&](int x, int y) {
    set += mask.get(x, y);
    ++all;
  });
  return 2 * set > all;
}

// --- alpha

/// Alpha tells something where it hides a part of the picture and shows another; a picture with rounded
/// corners does not count.
bool alpha_informs(const Channel& alpha) {
  const auto opaque =
      std::count_if(alpha.values.begin(), alpha.values.end(), [](float a) { return a > 0.5f; });
  const double share = static_cast<double>(opaque) / static_cast<double>(alpha.values.size());
  return opaque > 0 && share < 0.995;
}

Separation separate_by_alpha(const Channel& alpha, TreeSide side) {
  const Mask opaque = above(alpha, 0.5f);
  if (side == TreeSide::dark) return {inverse(opaque), "alpha below 0.5"};
  return {opaque, "alpha above 0.5"};
}

// --- luminance

/// The range of values without the outermost 0.1 % at each end: bright spots of a float picture must not
/// squeeze everything else into one bin.
struct Range {
  float lower = 0, upper = 0;
};

Range robust_range(std::vector<float> values) {
  const std::size_t cut = values.size() / 1000;
  const auto lower = values.begin() + static_cast<std::ptrdiff_t>(cut);
  const auto upper = values.end() - 1 - static_cast<std::ptrdiff_t>(cut);
  std::nth_element(values.begin(), lower, values.end());
  const float lower_value = *lower;
  std::nth_element(values.begin(), upper, values.end());
  if (lower_value < *upper) return {lower_value, *upper};
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return {*least, *most};
}

int bin_of(float value, const Range& range) {
  const float share = (value - range.lower) / (range.upper - range.lower);
  return std::min(static_cast<int>(std::clamp(share, 0.0f, 1.0f) * kBins), kBins - 1);
}

/// A threshold, and the tones on its two sides.
struct Split {
  float threshold = 0, dark_mean = 0, light_mean = 0;
  double near_a_mean = 0;  ///< share of pixels within a tenth of the contrast of their side's mean

  float contrast() const { return light_mean - dark_mean; }
};

Split split_by_otsu(const Channel& channel) {
  const Range range = robust_range(channel.values);
  if (!(range.upper > range.lower)) return {};
  std::vector<std::size_t> histogram(kBins, 0);
  for (const float value : channel.values) ++histogram[bin_of(value, range)];
  const float bin_width = (range.upper - range.lower) / kBins;
  Split split;
  split.threshold = range.lower + bin_width * static_cast<float>(otsu_threshold(histogram) + 1);
  double sum[2] = {0, 0}, count[2] = {0, 0};
  for (const float value : channel.values) {
    const int side = value > split.threshold;
    sum[side] += std::clamp(value, range.lower, range.upper);
    count[side] += 1;
  }
  if (count[0] == 0 || count[1] == 0) return {};
  split.dark_mean = static_cast<float>(sum[0] / count[0]);
  split.light_mean = static_cast<float>(sum[1] / count[1]);
  const float near = 0.1f * split.contrast();
  const auto is_near = [&](float value) {
    value = std::clamp(value, range.lower, range.upper);
    return std::min(std::fabs(value - split.dark_mean), std::fabs(value - split.light_mean)) < near;
  };
  split.near_a_mean =
      static_cast<double>(std::count_if(channel.values.begin(), channel.values.end(), is_near)) /
      static_cast<double>(channel.values.size());
  return split;
}

Separation separate_by_luminance(const Channel& luminance, const Split& split, TreeSide side) {
  const Mask light = above(luminance, split.threshold);
  const bool border_light = border_is_set(light);
  const bool tree_light = side == TreeSide::light || (side == TreeSide::automatic && !border_light);
  return {tree_light ? light : inverse(light),
          fmt::format("luminance {} {:.3f} (Otsu), the border is {}", tree_light ? "above" : "below",
                      split.threshold, border_light ? "light" : "dark")};
}

// --- background colour

/// The colour of the border: the median of each channel, and how far the border strays from it.
struct Background {
  std::array<float, 3> color{};
  float noise = 0;   ///< 90 % of the border pixels that are background are nearer than this
  double share = 0;  ///< of the border pixels, those near the colour
};

float color_distance(const Rgba& pixel, const std::array<float, 3>& color) {
  float largest = 0;
  for (int c = 0; c < 3; ++c) largest = std::max(largest, std::fabs(pixel[c] - color[c]));
  return largest;
}

Background sample_background(const DecodedPicture& picture) {
  std::vector<Rgba> border;
  visit_border(picture.width_px, picture.height_px,
               [&](int x, int y) { border.push_back(picture.at(x, y)); });
  Background background;
  std::vector<float> sorted(border.size());
  const auto quantile = [&](double q) {
    const auto at = sorted.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(sorted.size() - 1));
    std::nth_element(sorted.begin(), at, sorted.end());
    return *at;
  };
  for (int c = 0; c < 3; ++c) {
    std::transform(border.begin(), border.end(), sorted.begin(), [c](const Rgba& pixel) { return pixel[c]; });
    background.color[c] = quantile(0.5);
  }
  std::transform(border.begin(), border.end(), sorted.begin(),
                 [&](const Rgba& pixel) { return color_distance(pixel, background.color); });
  const auto near =
      std::count_if(sorted.begin(), sorted.end(), [](float distance) { return distance < 0.1f; });
  background.share = static_cast<double>(near) / static_cast<double>(sorted.size());
  background.noise = quantile(0.9 * background.share);
  return background;
}

Separation separate_by_background(const DecodedPicture& picture, const Background& background,
                                  TreeSide side) {
  const Channel distance =
      make_channel(picture, [&](const Rgba& pixel) { return color_distance(pixel, background.color); });
  const float threshold = std::clamp(3 * background.noise, 0.1f, 0.3f);
  const Mask differs = above(distance, threshold);
  const auto& [red, green, blue] = background.color;
  return {side == TreeSide::dark ? inverse(differs) : differs,
          fmt::format("{} {:.3f} from the border's colour ({:.2f}, {:.2f}, {:.2f})",
                      side == TreeSide::dark ? "nearer than" : "farther than", threshold, red, green, blue)};
}

/// Rec. 709 weights.
float luminance_of(const Rgba& rgba) { return 0.2126f * rgba[0] + 0.7152f * rgba[1] + 0.0722f * rgba[2]; }

float alpha_of(const Rgba& rgba) { return rgba[3]; }

/// Whether some channel of some two pixels differs visibly.
bool has_contrast(const DecodedPicture& picture) {
  Rgba least = picture.pixels.front(), most = least;
  for (const Rgba& pixel : picture.pixels)
    for (int c = 0; c < 3; ++c) {
      least[c] = std::min(least[c], pixel[c]);
      most[c] = std::max(most[c], pixel[c]);
    }
  return std::max({most[0] - least[0], most[1] - least[1], most[2] - least[2]}) >= kSmallestContrast;
}

/// Two tones, with at most soft edges between them: luminance then tells more exactly where the edge is.
bool is_two_tone(const Split& split) { return split.near_a_mean > 0.85 && split.contrast() > 0.3f; }

}  // namespace

int otsu_threshold(const std::vector<std::size_t>& histogram) {
  double all = 0, all_sum = 0, lower = 0, lower_sum = 0, best = -1;
  for (std::size_t bin = 0; bin < histogram.size(); ++bin) {
    all += static_cast<double>(histogram[bin]);
    all_sum += static_cast<double>(bin) * static_cast<double>(histogram[bin]);
  }
  int first_best = 0, last_best = 0;
  for (std::size_t bin = 0; bin + 1 < histogram.size(); ++bin) {
    lower += static_cast<double>(histogram[bin]);
    lower_sum += static_cast<double>(bin) * static_cast<double>(histogram[bin]);
    const double upper = all - lower;
    if (lower == 0 || upper == 0) continue;
    const double gap = lower_sum / lower - (all_sum - lower_sum) / upper;
    const double between = lower * upper * gap * gap;  // Otsu 1979, eq. 18, times all²
    if (between > best) first_best = static_cast<int>(bin);
    if (between >= best) last_best = static_cast<int>(bin);
    best = std::max(best, between);
  }
  return (first_best + last_best) / 2;
}

Separation separate_tree(const DecodedPicture& picture, SeparationMethod method, TreeSide side,
                         const std::string& name) {
  using enum SeparationMethod;
  if (method == alpha && !picture.has_alpha)
    throw_input_error("{}: has no alpha channel, expected one for the method 'alpha'", name);
  if (picture.has_alpha && (method == alpha || method == automatic)) {
    const Channel channel = make_channel(picture, alpha_of);
    if (method == alpha || alpha_informs(channel)) return separate_by_alpha(channel, side);
  }
  if (!has_contrast(picture)) {
    const auto [red, green, blue, _] = picture.pixels.front();
    throw_input_error("{}: shows no tree: all of it is of one colour ({:.2f}, {:.2f}, {:.2f})", name, red,
                      green, blue);
  }
  const Channel tones = make_channel(picture, luminance_of);
  const Split split = split_by_otsu(tones);
  const Background border = sample_background(picture);
  const bool one_background = border.share > 0.7;
  if (method == background || (method == automatic && one_background && !is_two_tone(split)))
    return separate_by_background(picture, border, side);
  if (split.contrast() < kSmallestContrast)
    throw_input_error("{}: shows no tree: it is of one tone (luminance {:.3f})", name, tones.values[0]);
  return separate_by_luminance(tones, split, side);
}

}  // namespace espalier
