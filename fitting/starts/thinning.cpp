#include <algorithm>
#include <cmath>
#include <optional>

#include <espalier/fitting/starts/thinning.h>

namespace espalier {

namespace {

constexpr int kThinningSteps = 12;

constexpr double kAim = 0.9;  ///< of the budget: estimates are means
constexpr int kDeepestLevel = 3;

using Row = std::optional<std::size_t>;

/// Scales a count towards zero, whole ones to a whole number unless that is nothing.
void thin_count(const ParameterTable& table, Row row, double factor, ParameterValues& values) {
  if (!row || values[*row] == 0) return;
  const ParameterInfo& info = table.rows[*row];
  double thinned = values[*row] * factor;
  if (info.scale == Scale::integer) thinned = std::trunc(thinned);
  if (thinned == 0) thinned = std::copysign(1.0, values[*row]);
  values[*row] = std::clamp(thinned, info.lower, info.upper);
}

/// Fewer leaves, as much larger: together they cover the same area.
void thin_leaves(const ParameterTable& table, double factor, ParameterValues& values) {
  const Row count = table.find(Role::leaf_count), length = table.find(Role::leaf_length);
  const double before = count ? values[*count] : 0;
  thin_count(table, count, factor, values);
  if (length && before != 0)
    values[*length] =
        std::min(values[*length] * std::sqrt(before / values[*count]), table.rows[*length].upper);
}

bool can_thin(const ParameterTable& table, Row row, const ParameterValues& values) {
  return row && std::fabs(values[*row]) > std::max(1.0, table.rows[*row].lower);
}

/// The count of branches of the last level that bears some, or the next level down towards the trunk that is
/// not yet 1.
Row deepest_branches(const ParameterTable& table, const ParameterValues& values) {
  const Row levels = table.find(Role::levels);
  int deepest = levels ? std::clamp(static_cast<int>(values[*levels]) - 1, 1, kDeepestLevel) : kDeepestLevel;
  while (deepest > 1 && !can_thin(table, table.find(Role::branch_count, deepest), values)) --deepest;
  return table.find(Role::branch_count, deepest);
}

/// Of a model that knows nothing before it has grown: thins what the plant, as far as it grew, has too much
/// of.
void thin_grown(const ParameterTable& table, const GrowthBudget& budget, const Plant& plant, double factor,
                ParameterValues& values) {
  const bool too_many_stems = static_cast<double>(plant.stems.size()) > budget.max_stems;
  if (too_many_stems || !can_thin(table, table.find(Role::leaf_count), values))
    thin_count(table, deepest_branches(table, values), factor, values);
  else
    thin_leaves(table, factor, values);
}

}  // namespace

void thin_to_budget(const Model& model, const GrowthBudget& budget, ParameterValues& values) {
  const ParameterTable& table = model.table();
  for (int step = 0; step < kThinningSteps; ++step) {
    const GrowthEstimate estimate = model.estimate(values);
    const double stem_factor = kAim * budget.max_stems / std::max(estimate.stems, 1.0);
    const double leaf_factor = kAim * budget.max_leaves / std::max(estimate.leaves, 1.0);
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
    plant.clear();
    const GrowthResult result = model.generate(values, seed, settings, plant);
    if (result.grown) return true;
    if (!model.estimate(values).is_known)
      thin_grown(model.table(), budget, plant, kAim / result.over_budget_factor, values);
    else
      budget.max_stems *= 0.7, budget.max_leaves *= 0.7;
  }
  return false;
}

}  // namespace espalier
