#include <algorithm>

#include <espalier/fitting/starts/roomy_budget.h>

namespace espalier {

GrowthBudget roomy_budget(const Model& model, Seed seed, GrowthBudget budget) {
  constexpr double kRoom = 3;
  Plant plant;
  if (!model.generate(model.table().defaults(), seed, {}, plant).grown) return budget;
  budget.max_stems = std::max(budget.max_stems, kRoom * static_cast<double>(plant.stems.size()));
  budget.max_leaves = std::max(budget.max_leaves, kRoom * static_cast<double>(plant.leaves.size()));
  return budget;
}

}  // namespace espalier
