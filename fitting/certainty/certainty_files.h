// What a run leaves of how sure it is: the archive's solutions as presets, and each parameter's certainty as
// a table and as a picture.
#pragma once
#include <filesystem>
#include <string>

#include <espalier/charts/chart_layout.h>
#include <espalier/fitting/certainty/certainty.h>

namespace espalier {

/// A row a parameter. Rises are of the dissimilarity; empty where the range ends.
std::string certainty_to_csv(const CertaintyReport& report);

struct CertaintyChart {
  ChartLayout layout;
  int width_px = 0, height_px = 0;
};

/// A row a parameter, the most certain first: its range with the archive's solutions, and what a step costs.
CertaintyChart draw_certainty(const CertaintyReport& report, const SolutionArchive& archive);

/// parameters.csv, parameters.svg and parameters.png in `directory`; nothing where nothing was measured.
void write_certainty(const std::filesystem::path& directory, const CertaintyReport& report,
                     const SolutionArchive& archive);

/// One or two lines for people; empty where nothing was measured.
std::string certainty_in_words(const CertaintyReport& report, const SolutionArchive& archive);

}  // namespace espalier
