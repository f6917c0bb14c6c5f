// Targets as fits see them: pictures, those of species drawn first.
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

/// Draws the silhouettes of species into `directory`/targets, unless an earlier execution did. Throws
/// InputError where that fails.
std::vector<ReadyTarget> draw_targets(const FitsDeclaration& fits, const std::filesystem::path& directory);

}  // namespace espalier
