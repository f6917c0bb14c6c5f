#include <algorithm>
#include <cmath>

#include <espalier/fitting/starts/measured_start.h>

namespace espalier {

namespace {

constexpr double kBareTrunk = 0.04;  ///< of the height: a foot that shows the trunk, not the crown

bool shows_trunk(const PictureReading& reading) {
  constexpr double kWidestTrunk = 0.45;  // of the crown's width
  return reading.crown_base >= kBareTrunk && reading.trunk_width < kWidestTrunk * reading.crown_width;
}

/// From where branches may grow: mounds and pots, which are in the picture, are filled with them too.
double lowest_base(const PictureReading& reading) {
  const bool stands_on_ground = reading.stand_height <= 0;
  return shows_trunk(reading) && stands_on_ground ? std::min(0.8 * reading.crown_base, 0.5) : 0;
}

/// By how much of its radius the trunk widens at the ground.
double seen_flare(const PictureReading& reading) {
  return std::clamp(reading.foot_width / reading.trunk_width - 1, 0.0, 2.0);
}

/// Radius over length of a trunk whose foot, flared, is as wide as the picture's.
double seen_ratio(const PictureReading& reading) { return 0.45 * reading.trunk_width; }

/// Ranges of the rows that bear roles.
class Ranges {
 public:
  explicit Ranges(const ParameterTable& table) : table_(table) {}

  void set(RoleOfLevel role, SearchRange range) {
    const auto row = table_.find(role.role, role.level);
    if (!row) return;
    const ParameterInfo& info = table_.rows[*row];
    if (range.lower <= info.upper && range.upper >= info.lower) by_name_[info.full_name()] = range;
  }
  void set_length(Role role, SearchRange range_m) {
    if (const auto row = table_.find(role); row && table_.rows[*row].unit == "m") set({role}, range_m);
  }
  const std::map<std::string, SearchRange>& by_name() const { return by_name_; }

 private:
  const ParameterTable& table_;
  std::map<std::string, SearchRange> by_name_;
};

/// The trunk as it is seen; wood that gets thinner from level to level as that of all species does: else
/// silhouettes are filled with it.
void limit_wood(const PictureReading& reading, TreeKind kind, double height_m, Ranges& ranges) {
  constexpr double kThickestBranch = 0.03;  // radius over the height of the tree
  const double ratio = seen_ratio(reading);
  const double most =
      std::min(kThickestBranch / std::max(ratio, 0.01), kind == TreeKind::leafless ? 2.0 : 1.2);
  ranges.set({Role::radius_power}, {1, 2.5});
  ranges.set({Role::branch_radius, 1}, {0.25 * most, most});
  ranges.set({Role::branch_radius, 2}, {0.3, std::max(most, 1.0)});
  const SearchRange ratios =
      shows_trunk(reading) ? SearchRange{std::max(0.002, 0.5 * ratio), std::clamp(1.3 * ratio, 0.006, 0.15)}
                           : SearchRange{0.005, 0.03};
  ranges.set({Role::trunk_ratio}, ratios);
  ranges.set_length(Role::trunk_radius, {ratios.lower * height_m, ratios.upper * height_m});
  if (shows_trunk(reading)) ranges.set({Role::trunk_flare}, {0, std::max(0.1, seen_flare(reading))});
}

/// Thin ribs, with leaflets that are long and narrow.
void limit_fronds(double height_m, Ranges& ranges) {
  ranges.set({Role::crown_base}, {0.75, 0.98});
  ranges.set({Role::branch_count, 1}, {10, 60});
  ranges.set({Role::branch_length, 1}, {0.08, 0.9});
  ranges.set({Role::branch_radius, 1}, {0.05, 0.4});
  ranges.set_length(Role::leaf_length, {0.015 * height_m, 0.06 * height_m});
  ranges.set({Role::leaf_width}, {0.04, 0.16});
  ranges.set({Role::leaf_count}, {60, 300});
}

/// Lengths are shares of the height; of the species, the longest have 3 %, and none is wider than its
/// outline.
void limit_leaves(LeafSizes sizes, double height_m, Ranges& ranges) {
  constexpr double kShortest = 0.003, kLongestOfSpecies = 0.03, kLongest = 0.035;
  const bool of_species = sizes == LeafSizes::of_species;
  ranges.set_length(Role::leaf_length,
                    {kShortest * height_m, (of_species ? kLongestOfSpecies : kLongest) * height_m});
  if (of_species) ranges.set({Role::leaf_width}, {0.05, 1});
  ranges.set({Role::leaf_count}, {8, 120});
}

void limit_crown(const PictureReading& reading, Ranges& ranges) {
  const double base = lowest_base(reading);
  ranges.set({Role::crown_base}, {base, std::max(0.6, base + 0.2)});
  ranges.set({Role::branch_length, 1}, {0.05, 0.9});
  ranges.set({Role::branch_length, 2}, {0.05, 0.7});
  ranges.set({Role::trunk_bend}, {-30, 30});
  ranges.set({Role::trunk_bend_variation}, {0, 50});
}

/// Across all directions: the picture's may be any of them.
double grown_width_m(const Model& model, const GrowthBudget& budget, Seed seed,
                     const ParameterValues& values) {
  Plant plant;
  if (!model.generate(values, seed, {budget, nullptr}, plant).grown) return 0;
  const Bounds box = bounds(plant);
  return 0.5 * static_cast<double>(box.upper.x - box.lower.x + box.upper.y - box.lower.y);
}

}  // namespace

std::map<std::string, SearchRange> measured_ranges(const ParameterTable& table, const PictureReading& reading,
                                                   TreeKind kind, double height_m, LeafSizes leaf_sizes) {
  Ranges ranges(table);
  limit_wood(reading, kind, height_m, ranges);
  ranges.set({Role::blossom_share}, {0, 0});  // a silhouette does not show them
  if (kind == TreeKind::palm) limit_fronds(height_m, ranges);
  if (kind == TreeKind::leafy) {
    limit_leaves(leaf_sizes, height_m, ranges);
    limit_crown(reading, ranges);
  }
  return ranges.by_name();
}

void take_measures(const Model& model, const GrowthBudget& budget, const PictureReading& reading,
                   double height_m, Seed plant_seed, ParameterValues& values) {
  const ParameterTable& table = model.table();
  if (shows_trunk(reading)) {
    set_role(table, {Role::trunk_ratio}, seen_ratio(reading), values);
    set_role(table, {Role::trunk_radius}, in_own_units(table, seen_ratio(reading) * height_m, values),
             values);
    set_role(table, {Role::trunk_flare}, seen_flare(reading), values);
    set_role(table, {Role::crown_base}, std::min(reading.crown_base, 0.6), values);
  }
  const auto length = table.find(Role::branch_length, 1);
  const double width_m = grown_width_m(model, budget, plant_seed, values);
  if (!length || width_m <= 0) return;
  const double factor = std::clamp(reading.crown_width * height_m / width_m, 0.4, 2.5);
  set_role(table, {Role::branch_length, 1}, factor * values[*length], values);
}

}  // namespace espalier
