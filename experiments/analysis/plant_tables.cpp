#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include <espalier/experiments/analysis/finished_fits.h>
#include <espalier/experiments/analysis/plant_tables.h>
#include <espalier/experiments/statistics/quantiles.h>

namespace espalier {

namespace {

using Rows = std::vector<std::size_t>;

std::string decimals(double value) { return std::isnan(value) ? "" : fmt::format("{:.3f}", value); }
std::string whole(double value) { return std::isnan(value) ? "" : fmt::format("{:.0f}", value); }

/// The numbers of these rows, as far as they have some.
std::vector<double> column(const CsvTable& results, const Rows& rows, const std::string& name) {
  std::vector<double> values;
  for (const std::size_t row : rows)
    if (const double value = results.number(row, name); !std::isnan(value)) values.push_back(value);
  return values;
}

std::vector<std::string> plant_row(const CsvTable& results, const Rows& rows) {
  const std::vector<double> wood = column(results, rows, "visible_wood");
  const std::vector<double> depth = column(results, rows, "depth_over_width");
  if (wood.empty()) return {};
  const auto [shallowest, deepest] = std::minmax_element(depth.begin(), depth.end());
  return {whole(static_cast<double>(wood.size())),
          decimals(median(wood)),
          decimals(*std::max_element(wood.begin(), wood.end())),
          decimals(*shallowest),
          decimals(median(depth)),
          decimals(*deepest),
          whole(median(column(results, rows, "leaves"))),
          whole(median(column(results, rows, "override_numbers")))};
}

/// Rows of finished runs whose targets `wanted` holds, by method.
template <typename Wanted>
std::map<std::string, Rows> rows_by_method(const CsvTable& results, Wanted wanted) {
  std::map<std::string, Rows> rows;
  for (std::size_t row = 0; row < results.rows.size(); ++row)
    if (results.text(row, "status") == "done" && wanted(results.text(row, "target")))
      rows[method_of(results, row)].push_back(row);
  return rows;
}

/// A mean, and the standard deviation around it.
struct Spread {
  double mean = NAN, deviation = NAN;
};

Spread spread_of(const std::vector<double>& values) {
  if (values.empty()) return {};
  const auto n = static_cast<double>(values.size());
  Spread spread{0, 0};
  for (const double value : values) spread.mean += value / n;
  for (const double value : values) spread.deviation += (value - spread.mean) * (value - spread.mean);
  spread.deviation = values.size() > 1 ? std::sqrt(spread.deviation / (n - 1)) : NAN;
  return spread;
}

double mean_of(const CsvTable& results, const Rows& rows, const char* name) {
  return spread_of(column(results, rows, name)).mean;
}

/// The fits beside the siblings, from both sides, the gains over them, and how the side's gain varies.
std::vector<std::string> side_row(const std::string& target, const CsvTable& results, const Rows& rows,
                                  const std::vector<double>& side_gains) {
  const double front = mean_of(results, rows, "front_iou"), side = mean_of(results, rows, "side_iou");
  const double sibling_front = mean_of(results, rows, "sibling_front_iou"),
               sibling_side = mean_of(results, rows, "sibling_side_iou");
  return {target,
          whole(static_cast<double>(rows.size())),
          decimals(front),
          decimals(sibling_front),
          decimals(side),
          decimals(sibling_side),
          decimals(front - sibling_front),
          decimals(side - sibling_side),
          decimals(spread_of(side_gains).deviation)};
}

double side_gain(const CsvTable& results, std::size_t row) {
  return results.number(row, "side_iou") - results.number(row, "sibling_side_iou");
}

}  // namespace

CsvTable plant_table(const CsvTable& results, const TargetGroups& groups) {
  CsvTable table{
      {"group", "method", "fits", "visible_wood_median", "visible_wood_most", "depth_over_width_least",
       "depth_over_width_median", "depth_over_width_most", "leaves_median", "override_numbers_median"},
      {},
      "plants.csv"};
  if (!results.has("visible_wood")) return table;
  const auto add = [&](const std::string& group, auto wanted) {
    for (const auto& [method, rows] : rows_by_method(results, wanted)) {
      std::vector<std::string> cells = plant_row(results, rows);
      if (cells.empty()) continue;
      cells.insert(cells.begin(), {group, method});
      table.rows.push_back(std::move(cells));
    }
  };
  add("all", [](const std::string&) { return true; });
  for (const auto& group : groups)
    add(group.first, [&](const std::string& target) {
      return std::find(group.second.begin(), group.second.end(), target) != group.second.end();
    });
  return table;
}

CsvTable side_table(const CsvTable& results) {
  CsvTable table{{"target", "runs", "front_iou", "sibling_front_iou", "side_iou", "sibling_side_iou",
                  "front_gain", "side_gain", "side_gain_deviation"},
                 {},
                 "sides.csv"};
  if (!results.has("side_iou")) return table;
  std::vector<std::string> targets;
  std::map<std::string, Rows> by_target, by_seed;
  Rows all;
  for (std::size_t row = 0; row < results.rows.size(); ++row) {
    if (results.text(row, "status") != "done" || std::isnan(results.number(row, "side_iou"))) continue;
    if (!by_target.contains(results.text(row, "target"))) targets.push_back(results.text(row, "target"));
    by_target[results.text(row, "target")].push_back(row);
    by_seed[results.text(row, "seed")].push_back(row);
    all.push_back(row);
  }
  const auto gains = [&](const Rows& rows) {
    std::vector<double> values;
    for (const std::size_t row : rows) values.push_back(side_gain(results, row));
    return values;
  };
  for (const std::string& target : targets)
    table.rows.push_back(side_row(target, results, by_target[target], gains(by_target[target])));
  std::vector<double> seeds;
  seeds.reserve(by_seed.size());
  for (const auto& [seed, rows] : by_seed) seeds.push_back(spread_of(gains(rows)).mean);
  if (!all.empty()) table.rows.push_back(side_row("all", results, all, seeds));
  return table;
}

}  // namespace espalier
