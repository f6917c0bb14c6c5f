#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include <espalier/core/error.h>
#include <espalier/experiments/statistics/power_law.h>

namespace espalier {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct Point {
  double x, y;
  std::size_t cluster;
};
using Points = std::vector<Point>;

Points logarithms(std::span<const double> sizes, std::span<const double> times,
                  std::span<const std::size_t> clusters) {
  Points points;
  for (std::size_t i = 0; i < sizes.size(); ++i)
    if (sizes[i] > 0 && times[i] > 0) points.push_back({std::log(sizes[i]), std::log(times[i]), clusters[i]});
  return points;
}

std::pair<double, double> mean_of(const Points& points) {
  double x_sum = 0, y_sum = 0;
  for (const Point& point : points) x_sum += point.x, y_sum += point.y;
  const auto n = static_cast<double>(points.size());
  return {x_sum / n, y_sum / n};
}

/// Sums of squares and products about the mean.
struct Moments {
  double xx = 0, xy = 0, yy = 0;
};

Moments moments(const Points& points, double x_mean, double y_mean) {
  Moments sums;
  for (const Point& point : points) {
    sums.xx += (point.x - x_mean) * (point.x - x_mean);
    sums.xy += (point.x - x_mean) * (point.y - y_mean);
    sums.yy += (point.y - y_mean) * (point.y - y_mean);
  }
  return sums;
}

bool sizes_differ(const Points& points) {
  for (const Point& point : points)
    if (point.x != points.front().x) return true;
  return false;
}

/// Σ over clusters of (Σ x̃·e)², x̃ from the mean and e the residual, and how many clusters there are.
std::pair<double, double> clustered_scores(const Points& points, double x_mean, double y_mean,
                                           double exponent) {
  std::map<std::size_t, double> scores;
  for (const Point& point : points) {
    const double from_mean = point.x - x_mean;
    scores[point.cluster] += from_mean * (point.y - y_mean - exponent * from_mean);
  }
  double sum = 0;
  for (const auto& [cluster, score] : scores) sum += score * score;
  return {sum, static_cast<double>(scores.size())};
}

/// All but the standard error.
PowerLaw fit_line(const Points& points, Moments& sums) {
  PowerLaw law{kNaN, kNaN, kNaN, points.size()};
  if (!sizes_differ(points)) return law;
  const auto [x_mean, y_mean] = mean_of(points);
  sums = moments(points, x_mean, y_mean);
  law.exponent = sums.xy / sums.xx;
  law.factor = std::exp(y_mean - law.exponent * x_mean);
  return law;
}

}  // namespace

PowerLaw fit_power_law(std::span<const double> sizes, std::span<const double> times) {
  ESPALIER_CHECK_EQ(sizes.size(), times.size());
  const Points points = logarithms(sizes, times, std::vector<std::size_t>(sizes.size(), 0));
  Moments sums;
  PowerLaw law = fit_line(points, sums);
  const double residual = std::fmax(0, sums.yy - law.exponent * sums.xy);
  if (points.size() > 2 && !std::isnan(law.exponent))
    law.standard_error = std::sqrt(residual / static_cast<double>(points.size() - 2) / sums.xx);
  return law;
}

PowerLaw fit_power_law(std::span<const double> sizes, std::span<const double> times,
                       std::span<const std::size_t> clusters) {
  ESPALIER_CHECK_EQ(sizes.size(), times.size());
  ESPALIER_CHECK_EQ(sizes.size(), clusters.size());
  const Points points = logarithms(sizes, times, clusters);
  Moments sums;
  PowerLaw law = fit_line(points, sums);
  if (std::isnan(law.exponent) || points.size() < 3) return law;
  const auto [x_mean, y_mean] = mean_of(points);
  const auto [scores, groups] = clustered_scores(points, x_mean, y_mean, law.exponent);
  const auto n = static_cast<double>(points.size());
  if (groups > 1)
    law.standard_error = std::sqrt(groups / (groups - 1) * (n - 1) / (n - 2) * scores) / sums.xx;
  return law;
}

}  // namespace espalier
