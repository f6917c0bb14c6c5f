// Targets as fits see them: pictures in the experiment's directory, copies of those that it names and drawn
// ones of species. The directory is complete: it can be moved, and goes on without the files it was begun
// with.
#pragma once
#include <filesystem>
#include <optional>
#include <vector>

#include <espalier/experiments/declaration/experiment.h>

namespace espalier {

struct ReadyTarget {
  TargetDeclaration declaration;
  std::vector<ViewRecord> views;
  std::optional<double> height_m;  ///< of its tree, where that is known
};

/// Copies pictures into `directory`/targets and draws the silhouettes of species there, unless an earlier
/// execution did. Throws InputError where that fails, or where a picture is another one by now.
std::vector<ReadyTarget> keep_targets(const FitsDeclaration& fits, const std::filesystem::path& directory);

}  // namespace espalier
