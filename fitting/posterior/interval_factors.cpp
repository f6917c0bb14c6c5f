#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <espalier/fitting/posterior/interval_factors.h>
#include <espalier/fitting/posterior/normal_scores.h>

namespace espalier {

namespace {

/// The score of the upper end of a central interval.
double end_of(double share) { return normal_quantile(0.5 + share / 2); }

double normal_density(double score) {
  return std::exp(-0.5 * score * score) / std::sqrt(2 * std::numbers::pi);
}

using OfIntervals = IntervalFactors;

/// How much a count of truths changes with the factor: 1 over the slope of an interval's share.
double factor_per_share(double share) { return 1 / (2 * normal_density(end_of(share)) * end_of(share)); }

/// Covariance of two intervals' factors, were the intervals right: truths in the narrower one are in both.
double covariance_by_chance(double share, double other, double plants) {
  return std::min(share, other) * (1 - std::max(share, other)) / plants * factor_per_share(share) *
         factor_per_share(other);
}

/// Variance of a weighted sum of factors.
double variance_by_chance(const OfIntervals& weights, double plants) {
  double sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i)
    for (std::size_t k = 0; k < weights.size(); ++k)
      sum += weights[i] * weights[k] * covariance_by_chance(kIntervals[i], kIntervals[k], plants);
  return sum;
}

/// What of a number is more than chance.
double beyond_chance(double number, double variance) {
  return number * number > variance ? number - variance / number : 0;
}

/// By how much more than 1 the counts say that the factors are.
OfIntervals counted_excess(std::vector<double> shares) {
  std::sort(shares.begin(), shares.end(),
            [](double a, double b) { return std::fabs(a - 0.5) < std::fabs(b - 0.5); });
  const auto plants = static_cast<double>(shares.size());
  const double closest_to_end = 0.5 / plants;  // all draws may lie on one side of the truth
  OfIntervals excess{};
  for (std::size_t k = 0; k < kIntervals.size(); ++k) {
    const double held = std::fabs(shares[static_cast<std::size_t>(kIntervals[k] * plants)] - 0.5);
    excess[k] = normal_quantile(std::min(0.5 + held, 1 - closest_to_end)) / end_of(kIntervals[k]) - 1;
  }
  return excess;
}

}  // namespace

/// What all intervals have in common is known better than how they differ, so each has its own chance.
IntervalFactors interval_factors(std::vector<double> shares) {
  IntervalFactors factors;
  factors.fill(1);
  if (shares.empty()) return factors;
  const auto plants = static_cast<double>(shares.size());
  const OfIntervals excess = counted_excess(std::move(shares));
  constexpr double kPart = 1.0 / static_cast<double>(kIntervals.size());
  OfIntervals equal_parts;
  equal_parts.fill(kPart);
  const double common = kPart * std::accumulate(excess.begin(), excess.end(), 0.0);
  for (std::size_t k = 0; k < factors.size(); ++k) {
    OfIntervals from_common;
    from_common.fill(-kPart);
    from_common[k] += 1;
    factors[k] += beyond_chance(common, variance_by_chance(equal_parts, plants)) +
                  beyond_chance(excess[k] - common, variance_by_chance(from_common, plants));
  }
  return factors;
}

double factor_at(const IntervalFactors& factors, double score) {
  const double place = std::fabs(score);
  for (std::size_t k = 0; k < kIntervals.size(); ++k) {
    const double end = end_of(kIntervals[k]);
    if (place > end) continue;
    if (k == 0) return factors[0];
    const double start = end_of(kIntervals[k - 1]);
    return std::lerp(factors[k - 1], factors[k], (place - start) / (end - start));
  }
  return factors.back();
}

}  // namespace espalier
