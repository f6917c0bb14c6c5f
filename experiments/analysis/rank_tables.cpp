#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <espalier/experiments/analysis/rank_tables.h>
#include <espalier/experiments/runner/plan.h>
#include <espalier/experiments/statistics/paired_tests.h>
#include <espalier/experiments/statistics/quantiles.h>
#include <espalier/experiments/statistics/ranks.h>

namespace espalier {

namespace {

using Fits = std::vector<FinishedFit>;
using Names = std::vector<std::string>;

constexpr double kAlpha = 0.05;
constexpr std::size_t kMostInPairs = 6;  // more have so many pairs that Holm's correction leaves none

double measured(const FinishedFit& fit, const std::string& measure) {
  const auto found = fit.measures.find(measure);
  return found == fit.measures.end() ? NAN : found->second;
}

bool is_measured(const Fits& fits, const std::string& measure) {
  return std::ranges::any_of(fits,
                             [&](const FinishedFit& fit) { return !std::isnan(measured(fit, measure)); });
}

/// The mean over a method's seeds on a target; a failed run counts as 0. NaN where it has other than `seeds`
/// runs.
double mean_on(const Fits& fits, const std::string& target, const std::string& method,
               const std::string& measure, std::size_t seeds) {
  double sum = 0;
  std::size_t runs = 0;
  for (const FinishedFit& fit : fits) {
    if (fit.target != target || fit.method != method) continue;
    const double value = measured(fit, measure);
    sum += fit.failed || std::isnan(value) ? 0 : value;
    ++runs;
  }
  return runs == seeds ? sum / static_cast<double>(runs) : NAN;
}

/// Targets on which a method's runs are missing are left out.
BlockValues target_blocks(const Fits& fits, const Names& methods, const std::string& measure) {
  const std::size_t seeds = in_order(fits, &FinishedFit::seed).size();
  BlockValues blocks;
  for (const std::string& target : in_order(fits, &FinishedFit::target)) {
    std::vector<double> block;
    for (const std::string& method : methods) block.push_back(mean_on(fits, target, method, measure, seeds));
    if (std::ranges::none_of(block, [](double value) { return std::isnan(value); })) blocks.push_back(block);
  }
  return blocks;
}

double median_of(const Fits& fits, const std::string& method, auto value_of) {
  std::vector<double> values;
  for (const FinishedFit& fit : fits)
    if (const double value = value_of(fit); fit.method == method && !std::isnan(value))
      values.push_back(value);
  return median(values);
}

std::vector<std::size_t> best_first(const std::vector<double>& ranks) {
  std::vector<std::size_t> order(ranks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return ranks[a] < ranks[b]; });
  return order;
}

CsvTable rank_table(const Fits& fits, const Names& methods, const BlockValues& blocks,
                    const std::string& measure) {
  const std::vector<double> ranks = mean_ranks(blocks);
  const auto groups = rank_groups(ranks, nemenyi_critical_difference(methods.size(), blocks.size(), kAlpha));
  CsvTable table{{"optimizer", "mean_rank", "group", "median", "median_seconds", "runs"}, {}, ""};
  for (const std::size_t i : best_first(ranks)) {
    const auto runs = std::ranges::count_if(
        fits, [&](const FinishedFit& fit) { return fit.method == methods[i] && !fit.failed; });
    table.rows.push_back(
        {methods[i], table_cell(ranks[i]), groups[i],
         table_cell(
             median_of(fits, methods[i], [&](const FinishedFit& fit) { return measured(fit, measure); })),
         table_cell(median_of(fits, methods[i], [](const FinishedFit& fit) { return fit.seconds; })),
         fmt::format("{}", runs)});
  }
  return table;
}

CsvTable friedman_table(const BlockValues& blocks) {
  const FriedmanTest test = friedman_test(blocks);
  CsvTable table{{"statistic", "value"}, {}, ""};
  const auto add = [&](const char* name, double value) { table.rows.push_back({name, table_cell(value)}); };
  add("blocks", static_cast<double>(test.blocks));
  add("treatments", static_cast<double>(test.treatments));
  add("chi_squared", test.chi_squared);
  add("degrees_of_freedom", test.degrees_of_freedom);
  add("p_value", test.p_value);
  add("iman_davenport_f", test.iman_davenport_f);
  add("iman_davenport_p", test.iman_davenport_p);
  add("critical_difference", nemenyi_critical_difference(test.treatments, test.blocks, kAlpha));
  add("alpha", kAlpha);
  return table;
}

/// What method a reached beyond b, target by target.
std::vector<double> differences(const BlockValues& blocks, std::size_t a, std::size_t b) {
  std::vector<double> values;
  for (const auto& block : blocks) values.push_back(block[a] - block[b]);
  return values;
}

CsvTable pair_table(const Names& methods, const BlockValues& blocks) {
  CsvTable table{
      {"better", "worse", "targets", "median_difference", "lower_95", "upper_95", "p_value", "p_holm"},
      {},
      ""};
  std::vector<double> p_values;
  for (std::size_t i = 0; i < methods.size(); ++i)
    for (std::size_t j = i + 1; j < methods.size(); ++j) {
      const bool in_order = median(differences(blocks, i, j)) >= 0;
      const std::size_t better = in_order ? i : j, worse = in_order ? j : i;
      const std::vector<double> gains = differences(blocks, better, worse);
      const MedianInterval interval = median_interval(gains, 1 - kAlpha);
      p_values.push_back(signed_rank_test(gains).p_value);
      table.rows.push_back({methods[better], methods[worse], fmt::format("{}", gains.size()),
                            table_cell(median(gains)), table_cell(interval.lower), table_cell(interval.upper),
                            table_cell(p_values.back())});
    }
  const std::vector<double> adjusted = holm_adjusted(p_values);
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    table.rows[row].push_back(table_cell(adjusted[row]));
  return table;
}

}  // namespace

std::vector<std::string> ranked_measures(const Fits& fits) {
  Names measures(std::begin(kMeasuresInCommon), std::end(kMeasuresInCommon));
  if (in_order(fits, &FinishedFit::objective).size() <= 1)
    measures.assign(std::begin(kMeasuresOfOneObjective), std::end(kMeasuresOfOneObjective));
  std::erase_if(measures, [&](const std::string& measure) { return !is_measured(fits, measure); });
  return measures;
}

std::map<std::string, CsvTable> rank_tables(const Fits& fits) {
  std::map<std::string, CsvTable> tables;
  const Names methods = in_order(fits, &FinishedFit::method);
  if (methods.size() < 2) return tables;
  for (const std::string& measure : ranked_measures(fits)) {
    const BlockValues blocks = target_blocks(fits, methods, measure);
    if (blocks.empty()) continue;
    tables.emplace(fmt::format("ranks_{}.csv", measure), rank_table(fits, methods, blocks, measure));
    if (blocks.size() < 2) continue;
    tables.emplace(fmt::format("friedman_{}.csv", measure), friedman_table(blocks));
    if (methods.size() <= kMostInPairs)
      tables.emplace(fmt::format("pairs_{}.csv", measure), pair_table(methods, blocks));
  }
  return tables;
}

}  // namespace espalier
