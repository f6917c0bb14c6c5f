// The directory of an experiment: its declaration, a lock, the drawn targets, one directory a run, and the
// tables. Everything is written whole, so that an experiment killed at any moment goes on.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <espalier/experiments/declaration/experiment.h>
#include <espalier/experiments/runner/plan.h>

namespace espalier {

/// Throws InputError where the directory holds other files, or runs that the experiment does not have as they
/// are: it may have more of them.
void check_experiment_directory(const std::filesystem::path& directory, const Experiment& experiment);

/// What the directory was made with, where that had other runs.
std::optional<Experiment> earlier_experiment(const std::filesystem::path& directory,
                                             const Experiment& experiment);

/// experiment.toml, as the user gave it; and, where NAME.expected.toml lies beside it, that as
/// experiment.expected.toml.
void write_declaration(const std::filesystem::path& directory, const Experiment& experiment);

/// experiment.toml alone.
void write_declared_text(const std::filesystem::path& directory, const std::string& text);

/// Where the directory keeps its experiment's expectations, if it has some.
std::filesystem::path kept_expectations(const std::filesystem::path& directory);

/// runs/NAME below the experiment's directory.
std::filesystem::path run_directory(const std::filesystem::path& experiment_directory,
                                    const std::string& run);

/// A row of the experiment's table; no results yet where the run is not done.
struct RunRow {
  std::string run;
  Row labels;
  std::string status = "left";  ///< "done", "failed", "left"
  Measured measured;
  std::string error;
};

/// The row that a finished run left, if it is there. Failed runs leave none: they are tried again.
std::optional<Measured> read_finished(const std::filesystem::path& run_directory);
void write_finished(const std::filesystem::path& run_directory, const Measured& measured);

/// results.csv and times.csv of the runs that are done or have failed.
void write_tables(const std::filesystem::path& directory, const Plan& plan, const std::vector<RunRow>& rows);

}  // namespace espalier
