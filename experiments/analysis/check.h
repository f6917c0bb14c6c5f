// Compares what an experiment measured with what is expected of it: NAME.expected.toml beside its file.
//   [[expect]]
//   table = "results.csv"               # or one of the report, "growth_fit.csv"; results.csv if missing
//   where = { optimizer = "CMA-ES" }    # rows whose columns read so; all rows if missing
//   column = "pixel_accuracy"
//   statistic = "min"                   # of these rows: min, median, mean, max, count
//   at_least = 0.97                     # at_least, at_most, or value with tolerance
//   source = "dissertation, §4.4.2"     # what says so; not compared
#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace espalier {

struct Expectation {
  std::string table = "results.csv", column, statistic = "median", source;
  std::map<std::string, std::string> where;
  std::optional<double> at_least, at_most;
  std::string text() const;  ///< "median iou where optimizer is 'CMA-ES' at least 0.97"
};

struct CheckedExpectation {
  Expectation expectation;
  double got = 0;
  bool holds = false;
};

/// Throws InputError with file, line, key, got and expected.
std::vector<Expectation> read_expectations(const std::filesystem::path& path);

/// Throws InputError for tables or columns that are not there, and where no row is meant.
std::vector<CheckedExpectation> check_expectations(const std::vector<Expectation>& expectations,
                                                   const std::filesystem::path& directory);

}  // namespace espalier
