#include <algorithm>
#include <cmath>

#include <espalier/image/masks/distance_field.h>

namespace espalier {

namespace {

/// Where the parabolas of two samples meet.
double meeting(const std::vector<double>& f, int p, int q) {
  return ((f[static_cast<std::size_t>(q)] + q * q) - (f[static_cast<std::size_t>(p)] + p * p)) /
         (2.0 * (q - p));
}

/// The lower envelope of the parabolas (x - q)² + f(q), at each x.
std::vector<double> lower_envelope(const std::vector<double>& f) {
  const int count = static_cast<int>(f.size());
  std::vector<int> lowest{0};
  std::vector<double> from{-1e20};
  for (int q = 1; q < count; ++q) {
    double at = meeting(f, lowest.back(), q);
    while (at <= from.back()) {
      lowest.pop_back();
      from.pop_back();
      at = meeting(f, lowest.back(), q);
    }
    lowest.push_back(q);
    from.push_back(at);
  }
  std::vector<double> result(f.size());
  std::size_t k = 0;
  for (int x = 0; x < count; ++x) {
    while (k + 1 < from.size() && from[k + 1] < x) ++k;
    const double away = x - lowest[k];
    result[static_cast<std::size_t>(x)] = away * away + f[static_cast<std::size_t>(lowest[k])];
  }
  return result;
}

constexpr double kFar = 1e12;

/// Distances of all pixels to those that are (or are not) set, with a frame of the unset around them.
std::vector<float> distances_px(const Mask& mask, bool to_set) {
  const auto width = static_cast<std::size_t>(mask.width_px()) + 2,
             height = static_cast<std::size_t>(mask.height_px()) + 2;
  std::vector<std::vector<double>> columns(width, std::vector<double>(height, to_set ? kFar : 0));
  for (int y = 0; y < mask.height_px(); ++y)
    for (int x = 0; x < mask.width_px(); ++x)
      if (mask.get(x, y))
        columns[static_cast<std::size_t>(x) + 1][static_cast<std::size_t>(y) + 1] = to_set ? 0 : kFar;
  for (auto& column : columns) column = lower_envelope(column);
  std::vector<float> distances;
  distances.reserve((width - 2) * (height - 2));
  std::vector<double> row(width);
  for (std::size_t y = 1; y + 1 < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) row[x] = columns[x][y];
    const std::vector<double> nearest = lower_envelope(row);
    for (std::size_t x = 1; x + 1 < width; ++x)
      distances.push_back(static_cast<float>(std::sqrt(nearest[x])));
  }
  return distances;
}

}  // namespace

std::vector<float> distances_to_unset_px(const Mask& mask) { return distances_px(mask, false); }

std::vector<float> distances_to_set_px(const Mask& mask) { return distances_px(mask, true); }

}  // namespace espalier
