#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <espalier/experiments/analysis/fit_tables.h>
#include <espalier/experiments/analysis/rank_tables.h>
#include <espalier/experiments/runner/plan.h>
#include <espalier/experiments/statistics/data_profile.h>
#include <espalier/experiments/statistics/quantiles.h>

namespace espalier {

namespace {

using Fits = std::vector<FinishedFit>;

constexpr std::size_t kGridPoints = 60;
constexpr std::size_t kMostTraces = 40;

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

/// Where the starts of these runs end, in the median; empty where no trace says.
std::string end_of_starts(const Fits& fits, const std::string& target, const std::string& method) {
  std::vector<double> ends;
  for (const FinishedFit& fit : fits)
    if (!fit.failed && fit.method == method && (target == "all" || fit.target == target) &&
        evaluations_of_starts(fit) > 0)
      ends.push_back(static_cast<double>(evaluations_of_starts(fit)));
  return ends.empty() ? "" : table_number(median(ends));
}

CsvTable convergence_table(const Fits& fits) {
  CsvTable table{{"target", "optimizer", "evaluations", "q25", "median", "q75", "runs", "starts"},
                 {},
                 "convergence.csv"};
  const std::vector<long> grid = grid_of(fits);
  std::vector<std::string> targets = in_order(fits, &FinishedFit::target);
  targets.insert(targets.begin(), "all");
  for (const std::string& target : targets)
    for (const std::string& method : in_order(fits, &FinishedFit::method)) {
      const std::string starts = end_of_starts(fits, target, method);
      for (const QuartileRow& row : quartile_curves(curves_of(fits, target, method), grid))
        table.rows.push_back({target, method, fmt::format("{}", row.evaluations), table_cell(row.q25),
                              table_cell(row.median), table_cell(row.q75), fmt::format("{}", row.curves),
                              starts});
    }
  return table;
}

CsvTable profile_table(const Fits& fits) {
  std::vector<ProfileRun> runs;
  for (const FinishedFit& fit : fits) runs.push_back({fit.method, fit.target, fit.curve});
  CsvTable table{{"optimizer", "evaluations", "share"}, {}, "data_profile.csv"};
  for (const ProfileRow& row : data_profiles(runs, grid_of(fits)))
    table.rows.push_back({row.optimizer, fmt::format("{}", row.evaluations), table_cell(row.share)});
  return table;
}

CsvTable generation_table(const Fits& fits) {
  CsvTable table{{"target", "optimizer", "seed", "evaluations", "generation", "batch_best", "best", "stage"},
                 {},
                 "generations.csv"};
  for (const FinishedFit& fit : fits)
    for (std::size_t i = 0; i < fit.trace.size(); ++i)
      table.rows.push_back({fit.target, fit.method, fit.seed, fmt::format("{}", fit.trace[i].evaluations),
                            fmt::format("{}", i), table_cell(fit.trace[i].batch_best),
                            table_cell(fit.trace[i].best), fit.trace[i].stage});
  return table;
}

}  // namespace

std::map<std::string, CsvTable> fit_tables(const Fits& fits) {
  std::map<std::string, CsvTable> tables;
  if (in_order(fits, &FinishedFit::objective).size() == 1)  // fitness by two objectives has two scales
    tables = {{"convergence.csv", convergence_table(fits)}, {"data_profile.csv", profile_table(fits)}};
  if (fits.size() <= kMostTraces) tables.emplace("generations.csv", generation_table(fits));
  tables.merge(rank_tables(fits));
  return tables;
}

}  // namespace espalier
