#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <espalier/core/error.h>
#include <espalier/core/toml/toml_section.h>
#include <espalier/experiments/analysis/check.h>
#include <espalier/experiments/runner/csv.h>
#include <espalier/experiments/statistics/quantiles.h>

namespace espalier {

namespace fs = std::filesystem;

namespace {

using Values = std::vector<double>;

struct Statistic {
  std::string name;
  double (*of)(const Values&);
};

const std::vector<Statistic>& statistics() {
  static const std::vector<Statistic> all{
      {"min", [](const Values& v) { return *std::min_element(v.begin(), v.end()); }},
      {"median", [](const Values& v) { return median(v); }},
      {"mean",
       [](const Values& v) {
         return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
       }},
      {"max", [](const Values& v) { return *std::max_element(v.begin(), v.end()); }},
      {"count", [](const Values& v) { return static_cast<double>(v.size()); }}};
  return all;
}

const Statistic* find_statistic(const std::string& name) {
  for (const Statistic& statistic : statistics())
    if (statistic.name == name) return &statistic;
  return nullptr;
}

void read_limits(const TomlSection& section, Expectation& expectation) {
  if (section.has("at_least")) expectation.at_least = section.number("at_least");
  if (section.has("at_most")) expectation.at_most = section.number("at_most");
  if (section.has("value")) {
    const double value = section.number("value"), tolerance = section.number("tolerance");
    if (!(tolerance >= 0)) section.fail("tolerance", "a number from 0");
    expectation.at_least = value - tolerance;
    expectation.at_most = value + tolerance;
  }
  if (!expectation.at_least && !expectation.at_most)
    throw_input_error("{}: got no limit, expected at_least, at_most, or value and tolerance",
                      toml_location(section.source, section.table));
}

Expectation read_expectation(const TomlSection& section) {
  section.expect_only(
      {"table", "column", "statistic", "where", "at_least", "at_most", "value", "tolerance", "source"});
  Expectation expectation;
  expectation.table = section.text_or("table", expectation.table);
  expectation.column = section.text("column");
  expectation.source = section.text_or("source", "");
  expectation.statistic = section.text_or("statistic", expectation.statistic);
  if (!find_statistic(expectation.statistic)) section.fail("statistic", "min, median, mean, max or count");
  if (section.has("where")) {
    const TomlSection where = section.section("where");
    for (const auto& [key, value] : where.table)
      expectation.where[std::string(key.str())] = where.text(key.str());
  }
  read_limits(section, expectation);
  return expectation;
}

/// Tables of the report lie in it, results.csv and times.csv above.
CsvTable read_table(const fs::path& directory, const std::string& name) {
  const fs::path above = directory / name, report = directory / "report" / name;
  if (!fs::exists(above) && !fs::exists(report))
    throw_input_error("{}: got no table '{}', expected it there or in report/ (espalier experiment report)",
                      directory.string(), name);
  return read_csv(fs::exists(above) ? above : report);
}

bool is_meant(const CsvTable& table, std::size_t row, const Expectation& expectation) {
  return std::all_of(expectation.where.begin(), expectation.where.end(), [&](const auto& condition) {
    return table.text(row, condition.first) == condition.second;
  });
}

Values values_of(const CsvTable& table, const Expectation& expectation) {
  Values values;
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    if (is_meant(table, row, expectation))
      if (const double value = table.number(row, expectation.column); !std::isnan(value))
        values.push_back(value);
  if (values.empty())
    throw_input_error("{}: got no row with a number, expected some for: {}", table.source,
                      expectation.text());
  return values;
}

}  // namespace

std::string Expectation::text() const {
  std::string text = fmt::format("{} {}", statistic, column);
  for (const auto& [key, value] : where) text += fmt::format(", {} '{}'", key, value);
  if (at_least) text += fmt::format(", at least {:.6g}", *at_least);
  if (at_most) text += fmt::format(", at most {:.6g}", *at_most);
  return text;
}

std::vector<Expectation> read_expectations(const fs::path& path) {
  const toml::table document = parse_toml(read_toml_text(path), path.string());
  const TomlSection root{document, path.string()};
  root.expect_only({"expect"});
  std::vector<Expectation> expectations;
  for (const TomlSection& section : root.sections("expect"))
    expectations.push_back(read_expectation(section));
  if (expectations.empty()) root.fail("expect", "at least one [[expect]]");
  return expectations;
}

std::vector<CheckedExpectation> check_expectations(const std::vector<Expectation>& expectations,
                                                   const fs::path& directory) {
  std::vector<CheckedExpectation> checked;
  for (const Expectation& expectation : expectations) {
    const Values values = values_of(read_table(directory, expectation.table), expectation);
    const double got = find_statistic(expectation.statistic)->of(values);
    const bool holds = !(expectation.at_least && got < *expectation.at_least) &&
                       !(expectation.at_most && got > *expectation.at_most);
    checked.push_back({expectation, got, holds});
  }
  return checked;
}

}  // namespace espalier
