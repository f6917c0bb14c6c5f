#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <espalier/experiments/analysis/growth_tables.h>
#include <espalier/experiments/runner/experiment_directory.h>
#include <espalier/experiments/runner/growth_runs.h>
#include <espalier/experiments/runner/plan.h>
#include <espalier/experiments/statistics/power_law.h>
#include <espalier/experiments/statistics/quantiles.h>

namespace espalier {

namespace fs = std::filesystem;

namespace {

/// Samples of earlier versions are of the parametric model alone.
std::string cell_of(const CsvTable& samples, std::size_t row, const std::string& column) {
  if (samples.has(column)) return samples.text(row, column);
  return column == "model" ? "weber_penn" : "";
}

/// samples.csv of all runs that are done.
CsvTable all_samples(const fs::path& directory) {
  const CsvTable results = read_csv(directory / "results.csv");
  CsvTable all{growth_sample_columns(), {}, "growth_times.csv"};
  for (std::size_t run = 0; run < results.rows.size(); ++run) {
    if (results.text(run, "status") != "done") continue;
    const CsvTable samples = read_csv(run_directory(directory, results.text(run, "run")) / "samples.csv");
    for (std::size_t row = 0; row < samples.rows.size(); ++row) {
      std::vector<std::string>& cells = all.rows.emplace_back();
      cells.reserve(all.columns.size());
      for (const std::string& column : all.columns) cells.push_back(cell_of(samples, row, column));
    }
  }
  return all;
}

std::vector<double> column(const CsvTable& samples, const std::string& name) {
  std::vector<double> values;
  values.reserve(samples.rows.size());
  for (std::size_t row = 0; row < samples.rows.size(); ++row) values.push_back(samples.number(row, name));
  return values;
}

/// Without the empty cells.
std::vector<double> known(std::vector<double> values) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  return values;
}

/// The trees of one species by one model.
struct Group {
  std::string species, model;
  CsvTable samples;
};

std::vector<Group> groups_of(const CsvTable& samples) {
  std::vector<Group> groups;
  for (std::size_t row = 0; row < samples.rows.size(); ++row) {
    const std::string species = samples.text(row, "species"), model = samples.text(row, "model");
    auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& known) {
      return known.species == species && known.model == model;
    });
    if (group == groups.end())
      group = groups.insert(groups.end(), {species, model, {samples.columns, {}, samples.source}});
    group->samples.rows.push_back(samples.rows[row]);
  }
  return groups;
}

CsvTable complexity_table(const std::vector<Group>& groups) {
  CsvTable table{{"species", "model", "min", "q25", "median", "q75", "max"}, {}, "growth_complexity.csv"};
  for (const Group& group : groups) {
    const std::vector<double> knots = column(group.samples, "knots");
    table.rows.push_back({group.species, group.model});
    for (const double p : {0.0, 0.25, 0.5, 0.75, 1.0})
      table.rows.back().push_back(table_number(quantile(knots, p)));
  }
  return table;
}

/// Of one tree all phases together, in milliseconds.
std::vector<double> whole_times_ms(const CsvTable& samples) {
  std::vector<double> times(samples.rows.size(), 0);
  for (const char* phase : {"stem_seconds", "leaf_seconds", "derivation_seconds", "interpretation_seconds"}) {
    const std::vector<double> seconds = column(samples, phase);
    for (std::size_t i = 0; i < times.size(); ++i)
      if (!std::isnan(seconds[i])) times[i] += 1000 * seconds[i];
  }
  return times;
}

/// As the dissertation's Fig. 4.4: how long trees take, and how much that differs from tree to tree.
CsvTable median_table(const std::vector<Group>& groups) {
  CsvTable table{{"species", "model", "median_ms", "q25_ms", "q75_ms", "stems_ms", "leaves_ms",
                  "derivation_ms", "interpretation_ms"},
                 {},
                 "growth_medians.csv"};
  for (const Group& group : groups) {
    const std::vector<double> whole = whole_times_ms(group.samples);
    table.rows.push_back({group.species, group.model});
    std::vector<std::string>& cells = table.rows.back();
    for (const double p : {0.5, 0.25, 0.75}) cells.push_back(table_number(quantile(whole, p)));
    for (const char* phase : {"stem_seconds", "leaf_seconds", "derivation_seconds", "interpretation_seconds"})
      cells.push_back(table_cell(1000 * median(known(column(group.samples, phase)))));
  }
  return table;
}

/// Trees of a species are as like each other as no others are: each species is a cluster.
std::vector<std::size_t> clusters_of(const CsvTable& samples) {
  std::map<std::string, std::size_t> numbers;
  std::vector<std::size_t> clusters;
  clusters.reserve(samples.rows.size());
  for (std::size_t row = 0; row < samples.rows.size(); ++row)
    clusters.push_back(numbers.emplace(samples.text(row, "species"), numbers.size()).first->second);
  return clusters;
}

/// A phase, what it is in proportion to, and what it is called.
struct Phase {
  const char *what, *sizes, *seconds;
};
constexpr Phase kPhases[] = {{"stems", "knots", "stem_seconds"},
                             {"leaves", "leaves", "leaf_seconds"},
                             {"derivation", "knots", "derivation_seconds"},
                             {"interpretation", "knots", "interpretation_seconds"}};

/// Phases that no tree has have no row.
CsvTable exponent_table(const CsvTable& samples) {
  CsvTable table{{"what", "exponent", "standard_error", "factor", "points"}, {}, "growth_fit.csv"};
  for (const auto& [what, sizes, seconds] : kPhases) {
    const PowerLaw law =
        fit_power_law(column(samples, sizes), column(samples, seconds), clusters_of(samples));
    if (law.points > 0)
      table.rows.push_back({what, table_number(law.exponent), table_cell(law.standard_error),
                            table_number(law.factor), fmt::format("{}", law.points)});
  }
  return table;
}

/// The exponent within the trees of each L-system, as the dissertation's Fig. 4.6, and how far apart the
/// sizes are that it is from.
CsvTable lsystem_table(const std::vector<Group>& groups) {
  CsvTable table{{"species", "model", "exponent", "standard_error", "points", "largest_over_smallest"},
                 {},
                 "growth_lsystems.csv"};
  for (const Group& group : groups) {
    const std::vector<double> knots = column(group.samples, "knots");
    const PowerLaw law = fit_power_law(knots, column(group.samples, "interpretation_seconds"));
    if (law.points == 0) continue;
    table.rows.push_back({group.species, group.model, table_cell(law.exponent),
                          table_cell(law.standard_error), fmt::format("{}", law.points),
                          table_number(std::ranges::max(knots) / std::ranges::min(knots))});
  }
  return table;
}

}  // namespace

std::map<std::string, CsvTable> growth_tables(const fs::path& directory) {
  const CsvTable samples = all_samples(directory);
  const std::vector<Group> groups = groups_of(samples);
  std::map<std::string, CsvTable> tables;
  for (CsvTable table : {samples, complexity_table(groups), median_table(groups), exponent_table(samples),
                         lsystem_table(groups)})
    if (!table.rows.empty()) tables.emplace(table.source, std::move(table));
  return tables;
}

}  // namespace espalier
