#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <espalier/core/error.h>
#include <espalier/experiments/statistics/power_law.h>

namespace espalier {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

using Points = std::vector<std::pair<double, double>>;

Points logarithms(std::span<const double> sizes, std::span<const double> times) {
  Points points;
  for (std::size_t i = 0; i < sizes.size(); ++i)
    if (sizes[i] > 0 && times[i] > 0) points.emplace_back(std::log(sizes[i]), std::log(times[i]));
  return points;
}

std::pair<double, double> mean_of(const Points& points) {
  double x_sum = 0, y_sum = 0;
  for (const auto& [x, y] : points) x_sum += x, y_sum += y;
  const auto n = static_cast<double>(points.size());
  return {x_sum / n, y_sum / n};
}

/// Sums of squares and products about the mean.
struct Moments {
  double xx = 0, xy = 0, yy = 0;
};

Moments moments(const Points& points, double x_mean, double y_mean) {
  Moments sums;
  for (const auto& [x, y] : points) {
    sums.xx += (x - x_mean) * (x - x_mean);
    sums.xy += (x - x_mean) * (y - y_mean);
    sums.yy += (y - y_mean) * (y - y_mean);
  }
  return sums;
}

bool sizes_differ(const Points& points) {
  for (const auto& point : points)
    if (point.first != points.front().first) return true;
  return false;
}

}  // namespace

PowerLaw fit_power_law(std::span<const double> sizes, std::span<const double> times) {
  ESPALIER_CHECK_EQ(sizes.size(), times.size());
  const Points points = logarithms(sizes, times);
  PowerLaw law{kNaN, kNaN, kNaN, points.size()};
  if (!sizes_differ(points)) return law;
  const auto [x_mean, y_mean] = mean_of(points);
  const Moments sums = moments(points, x_mean, y_mean);
  law.exponent = sums.xy / sums.xx;
  law.factor = std::exp(y_mean - law.exponent * x_mean);
  const double residual = std::fmax(0, sums.yy - law.exponent * sums.xy);
  if (points.size() > 2)
    law.standard_error = std::sqrt(residual / static_cast<double>(points.size() - 2) / sums.xx);
  return law;
}

}  // namespace espalier
