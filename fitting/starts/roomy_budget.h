// Room for plants that cannot be thinned.
#pragma once
#include <espalier/plant/model.h>

namespace espalier {

/// Plants of models other than the parametric one are not thinned to a growth budget: one that the model's
/// default plant, grown with this seed, keeps with room to spare, and no smaller than `budget`.
GrowthBudget roomy_budget(const Model& model, Seed seed, GrowthBudget budget);

}  // namespace espalier
