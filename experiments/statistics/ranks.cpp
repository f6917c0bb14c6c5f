#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include <espalier/core/error.h>
#include <espalier/experiments/statistics/ranks.h>

namespace espalier {

namespace {

namespace math = boost::math;

bool higher(double a, double b) { return !std::isnan(a) && (std::isnan(b) || a > b); }

std::vector<std::size_t> sorted_indices(std::size_t count, auto&& before) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), before);
  return order;
}

void check_blocks(const BlockValues& blocks) {
  ESPALIER_CHECK_EQ(!blocks.empty() && blocks.front().size() >= 2, true);
  for (const auto& block : blocks) ESPALIER_CHECK_EQ(block.size(), blocks.front().size());
}

double sum_of_squares(std::span<const double> values) {
  return std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
}

/// Friedman's chi-squared for any ties: (k-1)·Σ_j (R_j - N(k+1)/2)² / (Σ_ij r_ij² - N·k·(k+1)²/4), R_j the
/// sum of treatment j's ranks r_ij (Conover, Practical Nonparametric Statistics, 3rd ed. 1999, section 5.8,
/// T1).
double friedman_chi_squared(const BlockValues& blocks) {
  const double n = static_cast<double>(blocks.size()), k = static_cast<double>(blocks.front().size());
  double treatments = 0, spread = -n * k * (k + 1) * (k + 1) / 4;
  for (const double mean : mean_ranks(blocks)) treatments += std::pow(n * (mean - (k + 1) / 2), 2);
  for (const auto& block : blocks) spread += sum_of_squares(average_ranks(block));
  return spread > 0 ? (k - 1) * treatments / spread : 0;
}

/// Iman, Davenport 1980, in Demšar 2006, section 3.2.2: F_F with k - 1 and (k - 1)(N - 1) degrees of freedom.
void add_iman_davenport(FriedmanTest& test) {
  const double n = static_cast<double>(test.blocks), k = static_cast<double>(test.treatments);
  const double rest = n * (k - 1) - test.chi_squared;
  test.iman_davenport_f = test.iman_davenport_p = std::numeric_limits<double>::quiet_NaN();
  if (test.blocks < 2) return;
  if (rest <= n * k * 1e-12) {  // all blocks rank alike, up to rounding
    test.iman_davenport_f = std::numeric_limits<double>::infinity();
    test.iman_davenport_p = 0;
    return;
  }
  test.iman_davenport_f = (n - 1) * test.chi_squared / rest;
  const math::fisher_f distribution(k - 1, (k - 1) * (n - 1));
  test.iman_davenport_p = math::cdf(math::complement(distribution, test.iman_davenport_f));
}

/// P(range of k standard normal numbers <= range) = k ∫ φ(z)·(Φ(z) - Φ(z - range))^(k-1) dz (z is the
/// highest).
double range_probability(std::size_t k, double range) {
  const math::normal normal;
  const auto integrand = [&](double z) {
    const double inside = math::cdf(normal, z) - math::cdf(normal, z - range);
    return math::pdf(normal, z) * std::pow(inside, static_cast<double>(k - 1));
  };
  const double reach = 9;  // beyond it the density is below 1e-17
  return static_cast<double>(k) *
         math::quadrature::gauss_kronrod<double, 61>::integrate(integrand, -reach, reach, 10);
}

/// First and last place, in the order of ranks, of a group that cannot be made longer.
struct Group {
  std::size_t first = 0, last = 0;
};

std::vector<Group> longest_groups(std::span<const double> sorted_ranks, double critical_difference) {
  std::vector<Group> groups;
  for (std::size_t first = 0; first < sorted_ranks.size(); ++first) {
    std::size_t last = first;
    while (last + 1 < sorted_ranks.size() &&
           sorted_ranks[last + 1] - sorted_ranks[first] <= critical_difference)
      ++last;
    if (groups.empty() || last > groups.back().last) groups.push_back({first, last});
  }
  return groups;
}

std::string group_letter(std::size_t group) {
  const std::string letter(1, static_cast<char>('a' + group % 26));
  return group < 26 ? letter : letter + std::to_string(group / 26 + 1);
}

}  // namespace

std::vector<double> average_ranks(std::span<const double> values) {
  const auto order =
      sorted_indices(values.size(), [&](auto a, auto b) { return higher(values[a], values[b]); });
  std::vector<double> ranks(values.size());
  for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
    while (end < order.size() && !higher(values[order[first]], values[order[end]])) ++end;
    for (std::size_t i = first; i < end; ++i) ranks[order[i]] = static_cast<double>(first + 1 + end) / 2;
  }
  return ranks;
}

std::vector<double> mean_ranks(const BlockValues& blocks) {
  check_blocks(blocks);
  std::vector<double> means(blocks.front().size(), 0.0);
  for (const auto& block : blocks) {
    const std::vector<double> ranks = average_ranks(block);
    for (std::size_t i = 0; i < means.size(); ++i) means[i] += ranks[i];
  }
  for (double& mean : means) mean /= static_cast<double>(blocks.size());
  return means;
}

FriedmanTest friedman_test(const BlockValues& blocks) {
  check_blocks(blocks);
  FriedmanTest test{blocks.size(), blocks.front().size()};
  test.degrees_of_freedom = static_cast<double>(test.treatments - 1);
  test.chi_squared = friedman_chi_squared(blocks);
  test.p_value = math::cdf(math::complement(math::chi_squared(test.degrees_of_freedom), test.chi_squared));
  add_iman_davenport(test);
  return test;
}

double nemenyi_quantile(std::size_t treatments, double alpha) {
  ESPALIER_CHECK_EQ(treatments >= 2 && alpha > 0 && alpha < 1, true);
  const auto excess = [&](double range) { return range_probability(treatments, range) - (1 - alpha); };
  std::uintmax_t iterations = 100;
  const auto [low, high] =
      math::tools::toms748_solve(excess, 0.0, 18.0, math::tools::eps_tolerance<double>(40), iterations);
  return (low + high) / 2 / std::sqrt(2.0);
}

double nemenyi_critical_difference(std::size_t treatments, std::size_t blocks, double alpha) {
  const double n = static_cast<double>(blocks), k = static_cast<double>(treatments);
  ESPALIER_CHECK_EQ(blocks >= 1, true);
  return nemenyi_quantile(treatments, alpha) *
         std::sqrt(k * (k + 1) / (6 * n));  // Demšar 2006, section 3.2.2
}

std::vector<std::string> rank_groups(std::span<const double> mean_ranks, double critical_difference) {
  const auto order =
      sorted_indices(mean_ranks.size(), [&](auto a, auto b) { return mean_ranks[a] < mean_ranks[b]; });
  std::vector<double> sorted_ranks;
  sorted_ranks.reserve(order.size());
  for (const std::size_t i : order) sorted_ranks.push_back(mean_ranks[i]);
  const std::vector<Group> groups = longest_groups(sorted_ranks, critical_difference);
  std::vector<std::string> letters(mean_ranks.size());
  for (std::size_t group = 0; group < groups.size(); ++group)
    for (std::size_t place = groups[group].first; place <= groups[group].last; ++place)
      letters[order[place]] += group_letter(group);
  return letters;
}

}  // namespace espalier
