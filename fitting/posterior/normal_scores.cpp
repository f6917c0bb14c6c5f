#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <numbers>

#include <espalier/core/error.h>
#include <espalier/fitting/posterior/normal_scores.h>

namespace espalier {

double normal_share(double score) { return 0.5 * std::erfc(-score / std::numbers::sqrt2); }

double normal_quantile(double share) { return -std::numbers::sqrt2 * boost::math::erfc_inv(2 * share); }

NormalScores::NormalScores(std::span<const double> values) : sorted_(values.begin(), values.end()) {
  if (sorted_.size() < 2) throw InternalError("normal scores of fewer than two values");
  std::sort(sorted_.begin(), sorted_.end());
}

double NormalScores::score(double value) const {
  const auto [first, last] = std::equal_range(sorted_.begin(), sorted_.end(), value);
  const auto count = static_cast<double>(sorted_.size());
  const double place =
      0.5 * (static_cast<double>(first - sorted_.begin()) + static_cast<double>(last - sorted_.begin()));
  return normal_quantile(std::clamp(place, 0.5, count - 0.5) / count);
}

double NormalScores::value(double score) const {
  const auto count = static_cast<double>(sorted_.size());
  const double place = std::clamp(normal_share(score) * count - 0.5, 0.0, count - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted_.size() - 1);
  return std::lerp(sorted_[below], sorted_[above], place - static_cast<double>(below));
}

}  // namespace espalier
