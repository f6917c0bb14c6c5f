// The runner: expands an experiment, works on several runs at once, skips those that are done, and leaves
// tables. Killed at any moment, it goes on where it was when called again.
#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <espalier/experiments/runner/experiment_directory.h>

namespace espalier {

struct ExperimentProgress {
  std::size_t runs = 0, done = 0, failed = 0;
  std::optional<double> seconds_left;
  std::string posterior = {};  ///< after the runs: whose posterior is computed, and how far
};

struct RunnerOptions {
  int jobs = 0;  ///< runs at once; 0: one a processor
  std::function<bool()> stop_requested = [] { return false; };
  std::function<void(const ExperimentProgress&)> on_progress = [](const ExperimentProgress&) {
  };  ///< of any thread
};

struct ExperimentOutcome {
  Plan plan;
  std::vector<RunRow> rows;  ///< in the order of the plan
};

Plan plan_of(const Experiment& experiment, const std::filesystem::path& directory);

/// Runs what is left, also of an experiment that has more runs than the directory was made with. A run that
/// throws becomes a row with its error. Throws InputError for a directory of another experiment, or one that
/// another process works in.
ExperimentOutcome run_experiment(const Experiment& experiment, const std::filesystem::path& directory,
                                 const RunnerOptions& options = {});

}  // namespace espalier
