// What a run leaves of how sure it is: the archive's solutions as presets, and each parameter's
// identifiability as a table and as a picture.
#pragma once
#include <filesystem>
#include <string>

#include <espalier/charts/chart_layout.h>
#include <espalier/fitting/identifiability/identifiability.h>

namespace espalier {

/// A row a parameter. Rises are of the dissimilarity; empty where the range ends.
std::string identifiability_to_csv(const IdentifiabilityReport& report);

struct IdentifiabilityChart {
  ChartLayout layout;
  int width_px = 0, height_px = 0;
};

/// A row a parameter, the most certain first: its range with the archive's solutions, and what a step costs.
IdentifiabilityChart draw_identifiability(const IdentifiabilityReport& report,
                                          const SolutionArchive& archive);

/// parameters.csv, parameters.svg and parameters.png in `directory`; nothing where nothing was measured.
void write_identifiability(const std::filesystem::path& directory, const IdentifiabilityReport& report,
                           const SolutionArchive& archive);

/// One or two lines for people; empty where nothing was measured.
std::string identifiability_in_words(const IdentifiabilityReport& report, const SolutionArchive& archive);

}  // namespace espalier
