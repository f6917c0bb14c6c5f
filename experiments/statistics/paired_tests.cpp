#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <cstdint>
#include <numeric>

#include <espalier/core/error.h>
#include <espalier/core/random.h>
#include <espalier/experiments/statistics/paired_tests.h>
#include <espalier/experiments/statistics/quantiles.h>
#include <espalier/experiments/statistics/ranks.h>

namespace espalier {

namespace {

constexpr std::size_t kMostExactPairs = 25;

/// Ranks of the sizes of the differences, 1 for the smallest, twice as large, so that shared ranks are whole.
std::vector<std::size_t> doubled_ranks(const std::vector<double>& differences) {
  std::vector<double> sizes(differences.size());
  std::ranges::transform(differences, sizes.begin(), [](double value) { return -std::fabs(value); });
  std::vector<std::size_t> doubled;
  for (const double rank : average_ranks(sizes))
    doubled.push_back(static_cast<std::size_t>(std::lround(2 * rank)));
  return doubled;
}

/// How many of the 2^n choices of signs have each sum of doubled ranks.
std::vector<double> counts_of_sums(const std::vector<std::size_t>& doubled) {
  std::vector<double> counts(std::accumulate(doubled.begin(), doubled.end(), std::size_t{0}) + 1, 0.0);
  counts[0] = 1;
  for (const std::size_t rank : doubled)
    for (std::size_t sum = counts.size(); sum-- > rank;) counts[sum] += counts[sum - rank];
  return counts;
}

/// Sums are symmetric about their middle: twice the share of those at least as far out.
double exact_p_value(const std::vector<std::size_t>& doubled, std::size_t positive) {
  const std::vector<double> counts = counts_of_sums(doubled);
  const std::size_t total = counts.size() - 1, outer = std::min(positive, total - positive);
  const double tail = std::accumulate(counts.begin(), counts.begin() + static_cast<long>(outer) + 1, 0.0);
  return std::min(1.0, 2 * tail / std::pow(2.0, static_cast<double>(doubled.size())));
}

double normal_p_value(const std::vector<std::size_t>& doubled, std::size_t positive) {
  double squares = 0;  // of the ranks: with ties their sum is smaller, which is the correction
  for (const std::size_t rank : doubled) squares += 0.25 * static_cast<double>(rank * rank);
  const double sum =
      0.5 * static_cast<double>(std::accumulate(doubled.begin(), doubled.end(), std::size_t{0}));
  const double distance = std::fabs(0.5 * static_cast<double>(positive) - 0.5 * sum);
  const double z = std::max(0.0, distance - 0.5) / (0.5 * std::sqrt(squares));
  return 2 * boost::math::cdf(boost::math::complement(boost::math::normal(), z));
}

}  // namespace

SignedRankTest signed_rank_test(std::span<const double> differences) {
  std::vector<double> kept;
  for (const double value : differences) {
    ESPALIER_CHECK_EQ(std::isfinite(value), true);
    if (value != 0) kept.push_back(value);
  }
  if (kept.empty()) return {};
  const std::vector<std::size_t> doubled = doubled_ranks(kept);
  std::size_t positive = 0;
  for (std::size_t i = 0; i < kept.size(); ++i) positive += kept[i] > 0 ? doubled[i] : 0;
  const bool is_exact = kept.size() <= kMostExactPairs;
  return {0.5 * static_cast<double>(positive), kept.size(),
          is_exact ? exact_p_value(doubled, positive) : normal_p_value(doubled, positive)};
}

std::vector<double> holm_adjusted(std::span<const double> p_values) {
  std::vector<std::size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return p_values[a] < p_values[b]; });
  std::vector<double> adjusted(p_values.size());
  double largest = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    largest = std::max(largest, std::min(1.0, static_cast<double>(order.size() - i) * p_values[order[i]]));
    adjusted[order[i]] = largest;
  }
  return adjusted;
}

MedianInterval median_interval(std::span<const double> values, double coverage) {
  constexpr std::uint32_t kSamples = 10'000, kPurpose = 0x626f6f74;
  if (values.empty()) return {NAN, NAN};
  std::vector<double> medians, sample(values.size());
  medians.reserve(kSamples);
  for (std::uint32_t s = 0; s < kSamples; ++s) {
    const RandomKey key = child_key(root_key(0), s);
    for (std::size_t i = 0; i < sample.size(); ++i) {
      const double unit =
          static_cast<double>(random_bits(key, kPurpose, static_cast<std::uint32_t>(i)) >> 11) * 0x1p-53;
      sample[i] = values[static_cast<std::size_t>(unit * static_cast<double>(values.size()))];
    }
    medians.push_back(median(sample));
  }
  return {quantile(medians, (1 - coverage) / 2), quantile(medians, (1 + coverage) / 2)};
}

}  // namespace espalier
