// Runs of the kind [growth]: one species is grown with many seeds; samples.csv of the run holds how long its
// stems and its leaves took, and how many knots (points of the stems' curves) and leaves came of it.
#pragma once
#include <espalier/experiments/declaration/experiment.h>
#include <espalier/experiments/runner/plan.h>

namespace espalier {

Plan plan_growth(const GrowthDeclaration& growth);

}  // namespace espalier
