// What the fitted plants of an experiment are like, beyond their silhouettes: how much wood they show, how
// deep they are, what they need beyond their parameters; and, of known trees, how well the side that no
// picture shows is met.
#pragma once
#include <espalier/experiments/declaration/experiment.h>
#include <espalier/experiments/runner/csv.h>

namespace espalier {

/// By group and method: medians over all fits, and the extremes that a botanist would see first. Without
/// groups all targets are one. Of runs of earlier versions, which did not say, no row.
CsvTable plant_table(const CsvTable& results, const TargetGroups& groups);

/// By target: the fitted plants beside siblings of the tree, means over the seeds; the last row is of all
/// targets, its deviation that of the seeds' means. No row where no tree is known.
CsvTable side_table(const CsvTable& results);

}  // namespace espalier
