#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include <espalier/experiments/analysis/fit_tables.h>
#include <espalier/experiments/runner/plan.h>
#include <espalier/experiments/statistics/data_profile.h>
#include <espalier/experiments/statistics/quantiles.h>
#include <espalier/experiments/statistics/ranks.h>

namespace espalier {

namespace {

using Fits = std::vector<FinishedFit>;

constexpr std::size_t kGridPoints = 60;
constexpr std::size_t kMostTraces = 40;
constexpr double kAlpha = 0.05;

std::string cell(double value) { return std::isnan(value) ? "" : table_number(value); }

std::vector<long> grid_of(const Fits& fits) {
  long last = 1;
  for (const FinishedFit& fit : fits)
    if (!fit.curve.evaluations.empty()) last = std::max(last, fit.curve.evaluations.back());
  return log_grid(last, kGridPoints);
}

/// "all" is every target.
std::vector<StepCurve> curves_of(const Fits& fits, const std::string& target, const std::string& method) {
  std::vector<StepCurve> curves;
  for (const FinishedFit& fit : fits)
    if (!fit.failed && fit.method == method && (target == "all" || fit.target == target))
      curves.push_back(fit.curve);
  return curves;
}

CsvTable convergence_table(const Fits& fits) {
  CsvTable table{
      {"target", "optimizer", "evaluations", "q25", "median", "q75", "runs"}, {}, "convergence.csv"};
  const std::vector<long> grid = grid_of(fits);
  std::vector<std::string> targets = in_order(fits, &FinishedFit::target);
  targets.insert(targets.begin(), "all");
  for (const std::string& target : targets)
    for (const std::string& method : in_order(fits, &FinishedFit::method))
      for (const QuartileRow& row : quartile_curves(curves_of(fits, target, method), grid))
        table.rows.push_back({target, method, fmt::format("{}", row.evaluations), cell(row.q25),
                              cell(row.median), cell(row.q75), fmt::format("{}", row.curves)});
  return table;
}

CsvTable profile_table(const Fits& fits) {
  std::vector<ProfileRun> runs;
  for (const FinishedFit& fit : fits) runs.push_back({fit.method, fit.target, fit.curve});
  CsvTable table{{"optimizer", "evaluations", "share"}, {}, "data_profile.csv"};
  for (const ProfileRow& row : data_profiles(runs, grid_of(fits)))
    table.rows.push_back({row.optimizer, fmt::format("{}", row.evaluations), cell(row.share)});
  return table;
}

/// A block is a target and a seed: the fitness each method reached there. Blocks that a run is still missing
/// from are left out.
BlockValues blocks_of(const Fits& fits, const std::vector<std::string>& methods) {
  std::map<std::pair<std::string, std::string>, std::vector<double>> blocks;
  std::map<std::pair<std::string, std::string>, std::size_t> known;
  for (const FinishedFit& fit : fits) {
    auto& block = blocks[{fit.target, fit.seed}];
    block.resize(methods.size(), NAN);
    const auto method = std::find(methods.begin(), methods.end(), fit.method) - methods.begin();
    block[static_cast<std::size_t>(method)] = fit.failed ? NAN : fit.fitness;
    ++known[{fit.target, fit.seed}];
  }
  BlockValues complete;
  for (const auto& [key, block] : blocks)
    if (known[key] == methods.size()) complete.push_back(block);
  return complete;
}

double median_of(const Fits& fits, const std::string& method, double FinishedFit::*column) {
  std::vector<double> values;
  for (const FinishedFit& fit : fits)
    if (fit.method == method && !std::isnan(fit.*column)) values.push_back(fit.*column);
  return median(values);
}

CsvTable rank_table(const Fits& fits, const std::vector<std::string>& methods, const BlockValues& blocks) {
  const std::vector<double> ranks = mean_ranks(blocks);
  const auto groups = rank_groups(ranks, nemenyi_critical_difference(methods.size(), blocks.size(), kAlpha));
  std::vector<std::size_t> order(methods.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return ranks[a] < ranks[b]; });
  CsvTable table{{"optimizer", "mean_rank", "group", "median_fitness", "median_unseen_fitness",
                  "median_seconds", "runs"},
                 {},
                 "ranks.csv"};
  for (const std::size_t i : order) {
    const auto runs = std::count_if(fits.begin(), fits.end(), [&](const FinishedFit& fit) {
      return fit.method == methods[i] && !fit.failed;
    });
    table.rows.push_back({methods[i], cell(ranks[i]), groups[i],
                          cell(median_of(fits, methods[i], &FinishedFit::fitness)),
                          cell(median_of(fits, methods[i], &FinishedFit::unseen_fitness)),
                          cell(median_of(fits, methods[i], &FinishedFit::seconds)), fmt::format("{}", runs)});
  }
  return table;
}

CsvTable friedman_table(const BlockValues& blocks) {
  const FriedmanTest test = friedman_test(blocks);
  CsvTable table{{"statistic", "value"}, {}, "friedman.csv"};
  const auto add = [&](const char* name, double value) { table.rows.push_back({name, cell(value)}); };
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

CsvTable generation_table(const Fits& fits) {
  CsvTable table{{"target", "optimizer", "seed", "evaluations", "generation", "batch_best", "best"},
                 {},
                 "generations.csv"};
  for (const FinishedFit& fit : fits)
    for (std::size_t i = 0; i < fit.trace.size(); ++i)
      table.rows.push_back({fit.target, fit.method, fit.seed, fmt::format("{}", fit.trace[i].evaluations),
                            fmt::format("{}", i), cell(fit.trace[i].batch_best), cell(fit.trace[i].best)});
  return table;
}

}  // namespace

std::map<std::string, CsvTable> fit_tables(const Fits& fits) {
  std::map<std::string, CsvTable> tables{{"convergence.csv", convergence_table(fits)},
                                         {"data_profile.csv", profile_table(fits)}};
  if (fits.size() <= kMostTraces) tables.emplace("generations.csv", generation_table(fits));
  const std::vector<std::string> methods = in_order(fits, &FinishedFit::method);
  const BlockValues blocks = blocks_of(fits, methods);
  if (methods.size() < 2 || blocks.empty()) return tables;
  tables.emplace("ranks.csv", rank_table(fits, methods, blocks));
  if (blocks.size() > 1) tables.emplace("friedman.csv", friedman_table(blocks));
  return tables;
}

}  // namespace espalier
