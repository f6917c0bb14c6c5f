#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <espalier/core/error.h>
#include <espalier/experiments/statistics/rank_correlation.h>

namespace espalier {

namespace {

/// Twice the rank of each value, less n + 1: whole numbers that sum to 0. Equal values share their mean rank.
std::vector<double> centred_ranks(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> ranks(values.size());
  for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
    while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
    const double rank = static_cast<double>(first + end) - static_cast<double>(order.size());
    for (std::size_t i = first; i < end; ++i) ranks[order[i]] = rank;
  }
  return ranks;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

}  // namespace

double spearman_rho(std::span<const double> a, std::span<const double> b) {
  ESPALIER_CHECK_EQ(a.size(), b.size());
  const std::vector<double> ranks_a = centred_ranks(a), ranks_b = centred_ranks(b);
  return dot(ranks_a, ranks_b) / std::sqrt(dot(ranks_a, ranks_a) * dot(ranks_b, ranks_b));
}

}  // namespace espalier
