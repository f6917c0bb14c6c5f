// Runs of the kind [pictures]: each grows one tree and writes one shaded picture of it.
#pragma once
#include <espalier/experiments/declaration/experiment.h>
#include <espalier/experiments/runner/plan.h>

namespace espalier {

Plan plan_pictures(const PicturesDeclaration& pictures);

}  // namespace espalier
