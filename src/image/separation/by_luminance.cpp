#include <algorithm>
#include <cmath>

#include <espalier/core/error.h>
#include <espalier/image/masks/morphology.h>
#include <espalier/image/separation/by_luminance.h>
#include <espalier/image/separation/mask_parts.h>

namespace espalier {

namespace {

constexpr int kBins = 256;

/// Whether most of the border of what is shown is set.
bool border_is_set(const Mask& mask, const Mask& shown) {
  const int right = shown.width_px() - 1, bottom = shown.height_px() - 1;
  long set = 0, all = 0;
  for (int y = 0; y <= bottom; ++y)
    for (int x = 0; x <= right; ++x) {
      if (!shown.get(x, y)) continue;
      const bool is_inside = x > 0 && y > 0 && x < right && y < bottom && shown.get(x - 1, y) &&
                             shown.get(x + 1, y) && shown.get(x, y - 1) && shown.get(x, y + 1);
      if (is_inside) continue;
      set += mask.get(x, y);
      ++all;
    }
  return 2 * set > all;
}

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

/// Rec. 709 weights.
float luminance_of_pixel(const Rgba& rgba) {
  return 0.2126f * rgba[0] + 0.7152f * rgba[1] + 0.0722f * rgba[2];
}

/// As one row.
Channel shown_values(const Channel& channel, const Mask& shown) {
  Channel values;
  for (int y = 0; y < channel.height_px; ++y)
    for (int x = 0; x < channel.width_px; ++x)
      if (shown.get(x, y)) values.values.push_back(channel.at(x, y));
  values.width_px = static_cast<int>(values.values.size()), values.height_px = 1;
  return values;
}

}  // namespace

Channel luminance_of(const DecodedPicture& picture) { return make_channel(picture, luminance_of_pixel); }

ToneSplit split_tones(const Channel& luminance, const Mask& shown) {
  const Channel channel = shown_values(luminance, shown);
  const Range range = robust_range(channel.values);
  if (!(range.upper > range.lower)) return {};
  std::vector<std::size_t> histogram(kBins, 0);
  for (const float value : channel.values) ++histogram[bin_of(value, range)];
  const float bin_width = (range.upper - range.lower) / kBins;
  ToneSplit split;
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

Separation separate_by_luminance(const Channel& luminance, const ToneSplit& split, const Mask& shown,
                                 const SeparationOptions& options) {
  const bool border_light = border_is_set(above(luminance, split.threshold), shown);
  const bool tree_light =
      options.side == TreeSide::light || (options.side == TreeSide::automatic && !border_light);
  const bool is_asked = options.threshold != kHalfCovered;
  const float share = tree_light ? options.threshold : 1 - options.threshold;
  const float threshold = is_asked ? split.dark_mean + share * split.contrast() : split.threshold;
  const Mask light = above(luminance, threshold);
  return {both(tree_light ? light : complement(light), shown),
          fmt::format("luminance {} {:.3f} ({}), the border is {}", tree_light ? "above" : "below", threshold,
                      is_asked ? "as asked" : "Otsu", border_light ? "light" : "dark")};
}

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

}  // namespace espalier
