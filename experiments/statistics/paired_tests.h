// Does one method beat another on the same targets? Wilcoxon's signed-rank test, corrected for many pairs,
// and how large the difference is.
#pragma once
#include <span>
#include <vector>

namespace espalier {

struct SignedRankTest {
  double statistic = 0;   ///< sum of the ranks of positive differences
  std::size_t pairs = 0;  ///< differences that are not 0, which are left out (Wilcoxon 1945)
  double p_value = 1;     ///< two-sided
};

/// Exact up to 25 pairs, ties included (all 2^n signs are counted by a recursion over doubled ranks); above,
/// by the normal distribution with the correction for ties and continuity (Hollander, Wolfe, Chicken,
/// Nonparametric Statistical Methods, 3rd ed. 2014, section 3.1). Differences must be finite: InternalError.
SignedRankTest signed_rank_test(std::span<const double> differences);

/// p-values that may be compared with one level for all of them: Holm, "A simple sequentially rejective
/// multiple test procedure" (Scandinavian Journal of Statistics 6, 1979). In the order given; at most 1.
std::vector<double> holm_adjusted(std::span<const double> p_values);

struct MedianInterval {
  double lower = 0, upper = 0;
};

/// The percentile bootstrap of the median (Efron, Tibshirani, An Introduction to the Bootstrap, 1993, chapter
/// 13): 10,000 samples with replacement, the same in every call. NaN without values; `coverage` in (0, 1).
MedianInterval median_interval(std::span<const double> values, double coverage);

}  // namespace espalier
