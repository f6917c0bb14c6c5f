// A fit, from its record to its directory: reads the target, scores presets as start points, searches
// from the best of them, and keeps the directory up to date while it runs.
#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include <espalier/fitting/record/fit_record.h>
#include <espalier/fitting/run/plant_portrait.h>
#include <espalier/fitting/run/run_directory.h>
#include <espalier/fitting/task/fit_task.h>
#include <espalier/fitting/task/plant_scorer.h>
#include <espalier/render/scanlines/scanline_renderer.h>

namespace espalier {

struct FitProgress {
  long evaluations = 0, branch_steps = 0;
  double seconds = 0, best_fitness = 0;
  std::optional<double> seconds_left;  ///< of whichever limit comes first, if it can be told
};

/// What a run needs besides its record, and what does not change its result.
struct FitExecution {
  int threads = 0;                       ///< 0: one for each processor
  bool resume = false;                   ///< go on with the run in the directory
  const Model* model = nullptr;          ///< instead of the record's model by name; not owned
  const Optimizer* optimizer = nullptr;  ///< instead of the record's optimiser by name; not owned
  RendererFactory make_renderer = make_scanline_renderer;
  std::function<bool()> stop_requested = [] { return false; };  ///< asked before each batch
  std::function<void(const FitProgress&)> on_progress = [](const FitProgress&) {};
  std::function<void(const std::string&)> on_warning = [](const std::string&) {};  ///< before it begins
};

struct FitResult {
  ParameterValues values;
  double fitness = 0;   ///< 1 - dissimilarity, less the price of bare wood
  Overrides overrides;  ///< of the branches that were refined
  Seed seed = 0;        ///< of the tree that these overrides are of
  MaskMetrics metrics;
  std::optional<MaskMetrics> full_size_metrics;  ///< at 512 pixels, where branches were refined
  std::optional<PlantPortrait> portrait;         ///< none of a plant beyond the growth budget
  std::vector<Resemblance> resemblances;         ///< to the bundled species, the nearest first
  long evaluations = 0, branch_steps = 0;
  double seconds = 0;
  FitStop stopped_by = FitStop::evaluations;
  std::string best_start;
  std::size_t dimension = 0;
  CandidateFailures failures = {};  ///< since the run began or was resumed
};

/// Runs the fit. All input is checked before `directory` is made. Throws InputError, for the record, its
/// files, a directory that holds anything (without resume), or a run whose target changed (with it).
FitResult fit(const FitRecord& record, const std::filesystem::path& directory,
              const FitExecution& options = {});

}  // namespace espalier
