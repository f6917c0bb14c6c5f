#include <algorithm>
#include <array>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>

#include <espalier/core/error.h>
#include <espalier/core/random.h>
#include <espalier/experiments/statistics/calibration_bands.h>

namespace espalier {

namespace {

/// Logarithms of factorials of 0 … size.
std::vector<double> log_factorials(std::size_t size) {
  std::vector<double> logs(size + 1, 0.0);
  for (std::size_t i = 1; i <= size; ++i) logs[i] = logs[i - 1] + std::log(static_cast<double>(i));
  return logs;
}

struct CountRange {
  std::size_t first = 0, last = 0;
};

CountRange counts_within(double share, std::size_t trials, double deviations) {
  const auto n = static_cast<double>(trials);
  const double reach = deviations * std::sqrt(share * (1 - share) * n);
  return {static_cast<std::size_t>(std::max(0.0, std::ceil(share * n - reach))),
          static_cast<std::size_t>(std::min(n, std::floor(share * n + reach)))};
}

/// That the counts of all three intervals lie within: each interval holds the trials of the one inside it.
double chance_within(std::span<const double> shares, std::size_t trials, double deviations,
                     const std::vector<double>& log_factorial) {
  const std::array<double, 4> logs = {std::log(shares[0]), std::log(shares[1] - shares[0]),
                                      std::log(shares[2] - shares[1]), std::log(1 - shares[2])};
  const CountRange inner = counts_within(shares[0], trials, deviations),
                   middle = counts_within(shares[1], trials, deviations),
                   outer = counts_within(shares[2], trials, deviations);
  double chance = 0;
  for (std::size_t a = inner.first; a <= inner.last; ++a)
    for (std::size_t b = std::max(a, middle.first); b <= middle.last; ++b)
      for (std::size_t c = std::max(b, outer.first); c <= outer.last; ++c) {
        const std::array<std::size_t, 4> counts = {a, b - a, c - b, trials - c};
        double log_chance = log_factorial[trials];
        for (std::size_t k = 0; k < counts.size(); ++k)
          log_chance += static_cast<double>(counts[k]) * logs[k] - log_factorial[counts[k]];
        chance += std::exp(log_chance);
      }
  return chance;
}

/// Sorted, in (0, 1).
std::vector<double> uniform_ranks(std::size_t count, RandomKey key) {
  std::vector<double> ranks(count);
  for (std::size_t i = 0; i < count; ++i)
    ranks[i] =
        (static_cast<double>(random_bits(key, 0, static_cast<std::uint32_t>(i)) >> 11) + 0.5) * 0x1p-53;
  std::sort(ranks.begin(), ranks.end());
  return ranks;
}

std::size_t count_up_to(const std::vector<double>& sorted, double end) {
  return static_cast<std::size_t>(std::upper_bound(sorted.begin(), sorted.end(), end) - sorted.begin());
}

double point_at(std::size_t i, std::size_t points) {
  return static_cast<double>(i) / static_cast<double>(points);
}

constexpr std::size_t kDrawnCurves = 4000;

/// Of each point, the chances of as few ranks up to it, and of as many, doubled: their least over the points
/// says how odd a curve is. The `odd` most odd ones of all drawn may leave the band.
double oddness_at(std::size_t count, std::size_t points, double chance) {
  std::vector<std::vector<double>> two_sided(points);
  for (std::size_t i = 1; i < points; ++i) {
    const boost::math::binomial binomial(static_cast<double>(count), point_at(i, points));
    two_sided[i].reserve(count + 1);
    for (std::size_t k = 0; k <= count; ++k) {
      const double few = cdf(binomial, static_cast<double>(k)),
                   many = k == 0 ? 1.0 : cdf(complement(binomial, static_cast<double>(k - 1)));
      two_sided[i].push_back(2 * std::min(few, many));
    }
  }
  std::vector<double> least(kDrawnCurves, 1.0);
  for (std::size_t curve = 0; curve < kDrawnCurves; ++curve) {
    const std::vector<double> ranks = uniform_ranks(count, child_key(root_key(0x72616e6b), curve));
    for (std::size_t i = 1; i < points; ++i)
      least[curve] = std::min(least[curve], two_sided[i][count_up_to(ranks, point_at(i, points))]);
  }
  const auto odd =
      least.begin() + static_cast<std::ptrdiff_t>((1 - chance) * static_cast<double>(kDrawnCurves));
  std::nth_element(least.begin(), odd, least.end());
  return *odd;
}

}  // namespace

double joint_band_deviations(std::span<const double> shares, std::size_t trials, double chance) {
  if (shares.size() != 3) throw InternalError("bands of other than three intervals");
  const std::vector<double> logs = log_factorials(trials);
  double low = 0, high = 8;
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (low + high);
    (chance_within(shares, trials, middle, logs) >= chance ? high : low) = middle;
  }
  return high;
}

RankBand rank_band(std::size_t count, std::size_t points, double chance) {
  const double oddness = oddness_at(count, points, chance);
  RankBand band;
  for (std::size_t i = 1; i < points; ++i) {
    const boost::math::binomial binomial(static_cast<double>(count), point_at(i, points));
    std::size_t lower = 0, upper = count;
    while (2 * cdf(binomial, static_cast<double>(lower)) < oddness) ++lower;
    while (upper > 0 && 2 * cdf(complement(binomial, static_cast<double>(upper - 1))) < oddness) --upper;
    band.lower.push_back(static_cast<double>(lower) / static_cast<double>(count));
    band.upper.push_back(static_cast<double>(upper) / static_cast<double>(count));
  }
  return band;
}

bool is_within(const RankBand& band, std::span<const double> ranks) {
  std::vector<double> sorted(ranks.begin(), ranks.end());
  std::sort(sorted.begin(), sorted.end());
  const std::size_t points = band.lower.size() + 1;
  for (std::size_t i = 1; i < points; ++i) {
    const double share =
        static_cast<double>(count_up_to(sorted, point_at(i, points))) / static_cast<double>(sorted.size());
    if (share < band.lower[i - 1] || share > band.upper[i - 1]) return false;
  }
  return true;
}

}  // namespace espalier
