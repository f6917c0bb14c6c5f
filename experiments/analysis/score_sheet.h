// The score sheet of an experiment of fits whose targets are in groups: all metrics after each stage of each
// fit, beside those of the target's outline filled with no tree at all, which a fit must beat; the same by
// groups; and the pictures of each target's median run.
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>

#include <espalier/experiments/analysis/finished_fits.h>
#include <espalier/experiments/declaration/experiment.h>
#include <espalier/experiments/runner/csv.h>

namespace espalier {

struct ScoreSheet {
  CsvTable targets;              ///< a row a target, method and stage: means over the seeds, and their spread
  CsvTable groups;               ///< the same as means over the targets of each group, and over all
  nlohmann::ordered_json pages;  ///< what the page shows of each target
};

/// Draws each shown tree, seen from 45 degrees aside and a little above, into `directory`/report. Throws
/// InputError for runs whose files are missing or broken.
ScoreSheet score_sheet(const std::vector<FinishedFit>& fits, const TargetGroups& groups,
                       const std::filesystem::path& directory);

}  // namespace espalier
