#include <algorithm>
#include <cmath>

#include <espalier/core/error.h>
#include <espalier/overrides/overrides.h>

namespace espalier {

namespace {

struct QuantityRow {
  const char* name;
  double lower, upper;  ///< of values that replace the model's
};

/// What quantities are called, in the order of Quantity.
constexpr QuantityRow kQuantities[] = {
    {"length", 0, 1000},     {"position", 0, 1},         {"down_angle", -360, 360},
    {"rotation", -720, 720}, {"curvature", -1440, 1440}, {"curvature_back", -1440, 1440},
    {"radius", 0, 100},      {"child_count", 0, 10'000}, {"seed", 0, 4'294'967'295.0},
    {"removed", 0, 1},
};

const QuantityRow& row_of(Quantity quantity) { return kQuantities[static_cast<std::size_t>(quantity)]; }

bool is_relative(Quantity quantity) { return static_cast<std::size_t>(quantity) < kRelativeQuantities; }

auto lower_bound_of(auto& nodes, const BranchPath& path) {
  return std::lower_bound(nodes.begin(), nodes.end(), path,
                          [](const OverrideNode& node, const BranchPath& p) { return node.path < p; });
}

}  // namespace

OverrideNode& Overrides::at(const BranchPath& path) {
  const auto place = lower_bound_of(nodes, path);
  if (place != nodes.end() && place->path == path) return *place;
  return *nodes.insert(place, {path, {}});
}

OverrideSet& Overrides::set_of(const BranchPattern& pattern) {
  if (const auto path = as_path(pattern)) return at(*path).set;
  const auto found = std::find_if(ranges.begin(), ranges.end(),
                                  [&](const RangeNode& node) { return node.pattern == pattern; });
  return found == ranges.end() ? ranges.emplace_back(RangeNode{pattern, {}}).set : found->set;
}

const OverrideNode* Overrides::find(const BranchPath& path) const {
  const auto place = lower_bound_of(nodes, path);
  return place != nodes.end() && place->path == path ? &*place : nullptr;
}

const char* quantity_name(Quantity quantity) { return row_of(quantity).name; }

std::vector<std::string> quantity_names() {
  std::vector<std::string> names;
  for (const QuantityRow& row : kQuantities) names.emplace_back(row.name);
  return names;
}

void check_override(const Override& entry, const BranchPattern& pattern, const std::string& where) {
  const QuantityRow& row = row_of(entry.quantity);
  if (!is_relative(entry.quantity) && entry.relation != Relation::value)
    throw_input_error("{}: {}: got a factor or an offset, expected a value", where, row.name);
  if (entry.quantity == Quantity::position && pattern.size() == 1)
    throw_input_error("{}: {}: got one for trunk {}, expected a branch that has a parent", where, row.name,
                      to_string(pattern));
  const bool is_bounded = entry.relation == Relation::value;
  const double lower = is_bounded                                             ? row.lower
                       : entry.relation == Relation::factor && row.lower >= 0 ? 0
                                                                              : -1e6;
  const double upper = is_bounded ? row.upper : 1e6;
  if (!(entry.number >= lower && entry.number <= upper))
    throw_input_error("{}: {}: got {}, expected a number from {:g} to {:g}", where, row.name, entry.number,
                      lower, upper);
  if (!is_relative(entry.quantity) && entry.number != std::floor(entry.number))
    throw_input_error("{}: {}: got {}, expected a whole number", where, row.name, entry.number);
}

void set_override(OverrideSet& set, const Override& entry) {
  const auto place =
      std::lower_bound(set.overrides.begin(), set.overrides.end(), entry,
                       [](const Override& a, const Override& b) { return a.quantity < b.quantity; });
  if (place != set.overrides.end() && place->quantity == entry.quantity)
    *place = entry;
  else
    set.overrides.insert(place, entry);
}

void set_parameter(OverrideSet& set, const ParameterOverride& entry) {
  const auto place =
      std::lower_bound(set.parameters.begin(), set.parameters.end(), entry.key,
                       [](const ParameterOverride& a, const std::string& key) { return a.key < key; });
  if (place != set.parameters.end() && place->key == entry.key)
    *place = entry;
  else
    set.parameters.insert(place, entry);
}

}  // namespace espalier
