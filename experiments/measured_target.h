// What the programs of this folder that measure searches share: a target as a fit with default settings sees
// it, and where that fit begins.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include <espalier/fitting/starts/start_points.h>
#include <espalier/fitting/task/fit_task.h>
#include <espalier/fitting/task/scorer.h>

namespace espalier {

/// The model of all measurements.
const Model& measured_model();

/// A picture, or the silhouette of a bundled preset.
class MeasuredTarget {
 public:
  /// Draws the silhouette of a preset into a file of the folder for temporary ones. Throws InputError where
  /// there is neither a picture nor a preset of this name.
  explicit MeasuredTarget(const std::string& picture_or_preset);
  /// What a fit with masks of `size_px` compares; one tree a candidate, default budget and objective.
  FitTask task(int size_px) const;
  std::string name() const { return path_.stem().string(); }

 private:
  std::filesystem::path path_;
};

/// The start points of a fit, and the space around the best of them.
struct SearchBeginning {
  std::vector<StartPoint> starts;  ///< best first
  SearchSpace space;

  /// The three best, for an optimiser.
  std::vector<double> points() const;
};

/// Scores all presets with `scorer`, as a fit does.
SearchBeginning begin_search(const FitTask& task, Scorer& scorer);

/// What a program of this folder does with the targets named on its command line, one line of an error where
/// one is none; the program's exit code.
int measure_targets(int argc, char** argv, const std::string& table_head,
                    void (*measure)(const MeasuredTarget&));

}  // namespace espalier
