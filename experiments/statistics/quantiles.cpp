#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <espalier/core/error.h>
#include <espalier/experiments/statistics/quantiles.h>

namespace espalier {

double quantile(std::span<const double> values, double p) {
  ESPALIER_CHECK_EQ(p >= 0 && p <= 1, true);
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> sorted(values.begin(), values.end());
  for (const double value : sorted) ESPALIER_CHECK_EQ(value, value);  // no NaN: it has no place in an order
  std::sort(sorted.begin(), sorted.end());
  const double position = p * static_cast<double>(sorted.size() - 1);  // Hyndman, Fan 1996, definition 7
  const auto below = static_cast<std::size_t>(position);
  const double share = position - static_cast<double>(below);
  if (share == 0) return sorted[below];  // also where the next one is infinite, or there is none
  return sorted[below] + share * (sorted[below + 1] - sorted[below]);
}

double median(std::span<const double> values) { return quantile(values, 0.5); }

}  // namespace espalier
