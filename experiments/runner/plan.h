// What an experiment expands to: runs in an order, each with its directory, the labels of its row and the
// work that measures the rest of the row.
#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace espalier {

/// Columns of a table and their texts, in order.
using Row = std::vector<std::pair<std::string, std::string>>;

/// What a run measured.
struct Measured {
  Row results;  ///< the same for every execution
  Row times;    ///< wall times, which differ
};

/// What a run tells and asks while it works.
struct RunContext {
  std::function<bool()> stop_requested = [] { return false; };
  std::function<void(double share)> on_progress = [](double) {};  ///< of its work, 0..1
};

struct PlannedRun {
  std::string name;  ///< of its directory
  Row labels;        ///< columns known before
  /// Works in `directory`, which may hold an unfinished execution to go on with. Nothing where it was asked
  /// to stop. Throws where the run fails.
  std::function<std::optional<Measured>(const std::filesystem::path& directory, const RunContext& context)>
      execute;
};

struct Plan {
  std::vector<std::string> label_columns, result_columns, time_columns;
  std::vector<PlannedRun> runs;
  int threads_per_run = 1;
  bool one_at_a_time = false;  ///< runs that measure time must not disturb each other
};

/// A number as tables show it: six significant digits.
std::string table_number(double value);

/// The same, and an empty cell for NaN.
std::string table_cell(double value);

/// Appends "-2", "-3", … to names that were there before.
void make_names_unique(Plan& plan);

}  // namespace espalier
