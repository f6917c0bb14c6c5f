#include <algorithm>
#include <cmath>

#include <espalier/core/error.h>
#include <espalier/fitting/starts/thinning.h>

namespace espalier {

namespace {

constexpr int kThinningSteps = 12;

/// Scales a count towards zero, to a whole number unless that is nothing.
void thin_count(const ParameterTable& table, const std::string& name, double factor,
                ParameterValues& values) {
  const auto row = table.find(name);
  if (!row || values[*row] == 0) return;
  const double thinned = std::trunc(values[*row] * factor);
  values[*row] = thinned == 0 ? std::copysign(1.0, values[*row]) : thinned;
}

/// Fewer leaves, as much larger: together they cover the same area.
void thin_leaves(const ParameterTable& table, double factor, ParameterValues& values) {
  const auto count = table.find("leaf_blos_num"), scale = table.find("leaf_scale");
  const double before = count ? values[*count] : 0;
  thin_count(table, "leaf_blos_num", factor, values);
  if (scale && before != 0)
    values[*scale] = std::min(values[*scale] * std::sqrt(before / values[*count]), table.rows[*scale].upper);
}

/// "branches[2]" for a tree of three levels, or the next level down towards the trunk that is not yet 1.
std::string deepest_branches(const ParameterTable& table, const ParameterValues& values) {
  const auto levels = table.find("levels");
  int deepest = std::clamp(levels ? static_cast<int>(values[*levels]) - 1 : 0, 1, 3);
  for (; deepest > 1; --deepest) {
    const auto row = table.find(fmt::format("branches[{}]", deepest));
    if (row && std::fabs(values[*row]) > 1) break;
  }
  return fmt::format("branches[{}]", deepest);
}

}  // namespace

void thin_to_budget(const Model& model, const GrowthBudget& budget, ParameterValues& values) {
  const ParameterTable& table = model.table();
  for (int step = 0; step < kThinningSteps; ++step) {
    const GrowthEstimate estimate = model.estimate(values);
    const double stem_factor = 0.9 * budget.max_stems / std::max(estimate.stems, 1.0);
    const double leaf_factor = 0.9 * budget.max_leaves / std::max(estimate.leaves, 1.0);
    if (estimate.stems <= budget.max_stems && estimate.leaves <= budget.max_leaves) return;
    if (estimate.stems > budget.max_stems)
      thin_count(table, deepest_branches(table, values), stem_factor, values);
    else
      thin_leaves(table, leaf_factor, values);
  }
}

bool thin_until_grown(const Model& model, GrowthBudget budget, Seed seed, ParameterValues& values) {
  constexpr int kSteps = 6;
  const GrowthSettings settings{budget, nullptr};
  Plant plant;
  for (int step = 0; step < kSteps; ++step) {
    thin_to_budget(model, budget, values);
    if (model.generate(values, seed, settings, plant).grown) return true;
    budget.max_stems *= 0.7;
    budget.max_leaves *= 0.7;
  }
  return false;
}

}  // namespace espalier
