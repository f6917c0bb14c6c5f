// Runs of the kind [growth]: the trees of one species or L-system are grown with many seeds; samples.csv of
// the run holds how long each phase took (growth_phases.h), and how many knots (points of the stems' curves)
// and leaves came of it.
#pragma once
#include <string>
#include <vector>

#include <espalier/experiments/declaration/experiment.h>
#include <espalier/experiments/runner/plan.h>

namespace espalier {

/// Of samples.csv. Phases that a model does not have are empty cells.
std::vector<std::string> growth_sample_columns();

Plan plan_growth(const GrowthDeclaration& growth);

}  // namespace espalier
