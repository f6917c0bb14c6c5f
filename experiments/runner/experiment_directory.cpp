#include <nlohmann/json.hpp>

#include <espalier/core/error.h>
#include <espalier/core/files.h>
#include <espalier/experiments/runner/csv.h>
#include <espalier/experiments/runner/experiment_directory.h>
#include <espalier/machine/directory_lock.h>

namespace espalier {

namespace fs = std::filesystem;

namespace {

constexpr const char* kDeclaration = "experiment.toml";
constexpr const char* kFinished = "row.json";

bool holds_files(const fs::path& directory) {
  for (const auto& entry : fs::directory_iterator(directory))
    if (entry.path().filename() != kLockName && !is_temporary_name(entry.path())) return true;
  return false;
}

nlohmann::ordered_json to_json(const Row& row) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const auto& [column, text] : row) json[column] = text;
  return json;
}

Row row_of(const nlohmann::ordered_json& json) {
  Row row;
  for (const auto& [column, text] : json.items()) row.emplace_back(column, text.get<std::string>());
  return row;
}

std::string find_text(const Row& row, const std::string& column) {
  for (const auto& [name, text] : row)
    if (name == column) return text;
  return "";
}

std::vector<std::string> result_cells(const Plan& plan, const RunRow& row) {
  std::vector<std::string> cells{row.run};
  for (const std::string& column : plan.label_columns) cells.push_back(find_text(row.labels, column));
  cells.push_back(row.status);
  for (const std::string& column : plan.result_columns)
    cells.push_back(find_text(row.measured.results, column));
  cells.push_back(row.error);
  return cells;
}

CsvTable results_table(const Plan& plan, const std::vector<RunRow>& rows) {
  CsvTable table;
  table.columns = {"run"};
  table.columns.insert(table.columns.end(), plan.label_columns.begin(), plan.label_columns.end());
  table.columns.push_back("status");
  table.columns.insert(table.columns.end(), plan.result_columns.begin(), plan.result_columns.end());
  table.columns.push_back("error");
  for (const RunRow& row : rows)
    if (row.status != "left") table.rows.push_back(result_cells(plan, row));
  return table;
}

CsvTable times_table(const Plan& plan, const std::vector<RunRow>& rows) {
  CsvTable table;
  table.columns = {"run"};
  table.columns.insert(table.columns.end(), plan.time_columns.begin(), plan.time_columns.end());
  for (const RunRow& row : rows) {
    if (row.status != "done") continue;
    table.rows.push_back({row.run});
    for (const std::string& column : plan.time_columns)
      table.rows.back().push_back(find_text(row.measured.times, column));
  }
  return table;
}

}  // namespace

void check_experiment_directory(const fs::path& directory, const Experiment& experiment) {
  const fs::path path = directory / kDeclaration;
  std::error_code error;
  if (!fs::exists(directory, error)) return;
  if (!fs::is_directory(directory, error))
    throw_input_error("{}: got a file, expected a directory", directory.string());
  if (!fs::exists(path, error)) {
    if (holds_files(directory))
      throw_input_error("{}: got a directory with other files, expected a new one or that of '{}'",
                        directory.string(), experiment.words.name);
  } else if (const auto earlier = earlier_experiment(directory, experiment)) {
    if (const std::string change = change_of_runs(*earlier, experiment); !change.empty())
      throw_input_error("{}: {}, as its runs have it (others need another --out)", path.string(), change);
  }
}

std::optional<Experiment> earlier_experiment(const fs::path& directory, const Experiment& experiment) {
  const fs::path path = directory / kDeclaration;
  std::error_code error;
  if (!fs::exists(path, error)) return std::nullopt;
  const std::string text = read_file(path);
  if (same_runs(text, experiment.words.text)) return std::nullopt;
  try {
    return read_experiment_text(text, experiment.words.file);
  } catch (const InputError& failure) {
    throw_input_error(
        "{}: got another experiment, which cannot be read beside {} ({}), expected that of '{}'",
        path.string(), experiment.words.file.string(), failure.what(), experiment.words.name);
  }
}

void write_declaration(const fs::path& directory, const Experiment& experiment) {
  write_declared_text(directory, experiment.words.text);
  if (fs::is_regular_file(experiment.words.expectations))
    write_file_atomically(kept_expectations(directory), read_file(experiment.words.expectations));
}

void write_declared_text(const fs::path& directory, const std::string& text) {
  write_file_atomically(directory / kDeclaration, text);
}

fs::path kept_expectations(const fs::path& directory) { return directory / "experiment.expected.toml"; }

fs::path run_directory(const fs::path& experiment_directory, const std::string& run) {
  return experiment_directory / "runs" / run;
}

std::optional<Measured> read_finished(const fs::path& directory) {
  const fs::path path = directory / kFinished;
  if (!fs::exists(path)) return std::nullopt;
  try {
    const auto json = nlohmann::ordered_json::parse(read_file(path));
    return Measured{row_of(json.at("results")), row_of(json.at("times"))};
  } catch (const nlohmann::json::exception& error) {
    throw_input_error("{}: got no row of a run ({}), expected one", path.string(), error.what());
  }
}

void write_finished(const fs::path& directory, const Measured& measured) {
  make_directory(directory);
  const nlohmann::ordered_json json{{"results", to_json(measured.results)},
                                    {"times", to_json(measured.times)}};
  write_file_atomically(directory / kFinished, json.dump(2) + "\n");
}

void write_tables(const fs::path& directory, const Plan& plan, const std::vector<RunRow>& rows) {
  write_file_atomically(directory / "results.csv", to_csv(results_table(plan, rows)));
  write_file_atomically(directory / "times.csv", to_csv(times_table(plan, rows)));
}

}  // namespace espalier
