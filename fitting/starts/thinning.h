// Fewer leaves and branches, until a plant fits its growth budget: by the roles leaf_count, leaf_length and
// branch_count (core/parameter_role.h). A model without them is left as it is.
#pragma once
#include <espalier/core/parameter_table.h>
#include <espalier/core/random.h>
#include <espalier/plant/model.h>

namespace espalier {

/// Scales leaves and branches of the deepest level down until the estimate fits the budget; what is left of
/// the leaves grows so that it covers as much. A plant that does not get there in a few steps is left as thin
/// as it got; its score says so.
void thin_to_budget(const Model& model, const GrowthBudget& budget, ParameterValues& values);

/// The estimate is a mean: thins on until this seed's plant is within the budget too. False where a few steps
/// do not get there.
bool thin_until_grown(const Model& model, GrowthBudget budget, Seed seed, ParameterValues& values);

}  // namespace espalier
