#include <algorithm>
#include <cmath>

#include <espalier/fitting/branches/branch_offsets.h>

namespace espalier {

namespace {

/// Sets what differs from the model, and takes out what no longer does.
void set_or_drop(OverrideSet& set, const Override& entry, bool differs) {
  if (differs) return set_override(set, entry);
  std::erase_if(set.overrides, [&](const Override& other) { return other.quantity == entry.quantity; });
}

std::size_t count_numbers(const std::optional<DrawnAxis>& axis) { return axis ? 3 * axis->points.size() : 0; }

std::size_t count_numbers(const OverrideSet& set) {
  std::size_t count = set.overrides.size() + count_numbers(set.axis);
  for (const ParameterOverride& entry : set.parameters) count += entry.numbers.size();
  return count;
}

void read_override(const Override& entry, BranchOffsets& branch) {
  if (entry.quantity == Quantity::seed) branch.seed = static_cast<std::uint64_t>(entry.number);
  for (std::size_t i = 0; i < kBranchDimensions.size(); ++i) {
    const BranchDimension& d = kBranchDimensions[i];
    if (d.quantity != entry.quantity || d.relation != entry.relation) continue;
    branch.at[i] = (d.relation == Relation::factor ? std::log(entry.number) : entry.number) / d.range;
  }
}

}  // namespace

bool removes(const OverrideNode& node) {
  return std::any_of(node.set.overrides.begin(), node.set.overrides.end(), [](const Override& entry) {
    return entry.quantity == Quantity::removed && entry.number != 0;
  });
}

std::size_t count_numbers(const BranchOffsets& branch) {
  const auto moved = std::count_if(branch.at.begin(), branch.at.end(), [](double x) { return x != 0; });
  return static_cast<std::size_t>(moved) + (branch.seed != 0) + branch.removed + count_numbers(branch.axis);
}

std::size_t count_numbers(const Overrides& overrides) {
  std::size_t count = 0;
  for (const OverrideNode& node : overrides.nodes) count += count_numbers(node.set);
  for (const RangeNode& node : overrides.ranges) count += count_numbers(node.set);
  return count;
}

BranchOffsets read_offsets(const BranchPath& path, const Overrides& overrides) {
  BranchOffsets branch{.path = path};
  const OverrideNode* node = overrides.find(path);
  if (!node) return branch;
  branch.removed = removes(*node);
  branch.axis = node->set.axis;
  for (const Override& entry : node->set.overrides) read_override(entry, branch);
  return branch;
}

void write_offsets(const BranchOffsets& branch, Overrides& overrides) {
  OverrideSet& set = overrides.at(branch.path).set;
  for (std::size_t i = 0; i < kBranchDimensions.size(); ++i) {
    const BranchDimension& d = kBranchDimensions[i];
    if (d.quantity == Quantity::position && branch.path.size() == 1) continue;
    const double x = branch.at[i] * d.range;
    set_or_drop(set, {d.quantity, d.relation, d.relation == Relation::factor ? std::exp(x) : x, true},
                x != 0);
  }
  set_or_drop(set, {Quantity::seed, Relation::value, static_cast<double>(branch.seed), true},
              branch.seed != 0);
  set_or_drop(set, {Quantity::removed, Relation::value, 1, true}, branch.removed);
  set.axis = branch.axis;
}

Solution branch_alone(const BranchPath& path, const Solution& solution) {
  Solution one{solution.values, solution.plant_seed, {}, 1};
  one.overrides.ranges = solution.overrides.ranges;
  one.overrides.shared = solution.overrides.shared;
  for (const OverrideNode& node : solution.overrides.nodes) {
    const auto shared = static_cast<std::ptrdiff_t>(std::min(node.path.size(), path.size()));
    if (std::equal(node.path.begin(), node.path.begin() + shared, path.begin()))
      one.overrides.nodes.push_back(node);
  }
  return one;
}

}  // namespace espalier
