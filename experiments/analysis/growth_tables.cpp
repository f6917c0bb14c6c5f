#include <fmt/format.h>

#include <espalier/experiments/analysis/growth_tables.h>
#include <espalier/experiments/runner/experiment_directory.h>
#include <espalier/experiments/runner/plan.h>
#include <espalier/experiments/statistics/power_law.h>
#include <espalier/experiments/statistics/quantiles.h>

namespace espalier {

namespace fs = std::filesystem;

namespace {

/// samples.csv of all runs that are done.
CsvTable all_samples(const fs::path& directory) {
  const CsvTable results = read_csv(directory / "results.csv");
  CsvTable all{
      {"species", "seed", "knots", "leaves", "stem_seconds", "leaf_seconds"}, {}, "growth_times.csv"};
  for (std::size_t row = 0; row < results.rows.size(); ++row) {
    if (results.text(row, "status") != "done") continue;
    const CsvTable samples = read_csv(run_directory(directory, results.text(row, "run")) / "samples.csv");
    all.rows.insert(all.rows.end(), samples.rows.begin(), samples.rows.end());
  }
  return all;
}

std::vector<double> column(const CsvTable& samples, const std::string& name,
                           const std::string& species = "") {
  std::vector<double> values;
  for (std::size_t row = 0; row < samples.rows.size(); ++row)
    if (species.empty() || samples.text(row, "species") == species)
      values.push_back(samples.number(row, name));
  return values;
}

CsvTable complexity_table(const CsvTable& samples) {
  CsvTable table{{"species", "min", "q25", "median", "q75", "max"}, {}, "growth_complexity.csv"};
  std::string species;
  for (std::size_t row = 0; row < samples.rows.size(); ++row) {
    if (samples.text(row, "species") == species) continue;
    species = samples.text(row, "species");
    const std::vector<double> knots = column(samples, "knots", species);
    table.rows.push_back({species});
    for (const double p : {0.0, 0.25, 0.5, 0.75, 1.0})
      table.rows.back().push_back(table_number(quantile(knots, p)));
  }
  return table;
}

/// Trees of a species are as like each other as no others are: each species is a cluster.
std::vector<std::size_t> clusters_of(const CsvTable& samples) {
  std::map<std::string, std::size_t> numbers;
  std::vector<std::size_t> clusters;
  for (std::size_t row = 0; row < samples.rows.size(); ++row)
    clusters.push_back(numbers.emplace(samples.text(row, "species"), numbers.size()).first->second);
  return clusters;
}

std::vector<std::string> fit_row(const std::string& what, const CsvTable& samples, const char* sizes,
                                 const char* seconds) {
  const PowerLaw law = fit_power_law(column(samples, sizes), column(samples, seconds), clusters_of(samples));
  return {what, table_number(law.exponent), table_number(law.standard_error), table_number(law.factor),
          fmt::format("{}", law.points)};
}

CsvTable exponent_table(const CsvTable& samples) {
  CsvTable table{{"what", "exponent", "standard_error", "factor", "points"}, {}, "growth_fit.csv"};
  table.rows.push_back(fit_row("stems", samples, "knots", "stem_seconds"));
  table.rows.push_back(fit_row("leaves", samples, "leaves", "leaf_seconds"));
  return table;
}

}  // namespace

std::map<std::string, CsvTable> growth_tables(const fs::path& directory) {
  const CsvTable samples = all_samples(directory);
  return {{"growth_times.csv", samples},
          {"growth_complexity.csv", complexity_table(samples)},
          {"growth_fit.csv", exponent_table(samples)}};
}

}  // namespace espalier
