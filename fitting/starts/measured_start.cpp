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

void set_if_known(const ParameterTable& table, const char* name, double value, ParameterValues& values) {
  const auto row = table.find(name);
  if (row) values[*row] = std::clamp(value, table.rows[*row].lower, table.rows[*row].upper);
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

std::map<std::string, SearchRange> measured_ranges(const PictureReading& reading, TreeKind kind,
                                                   double height_m) {
  std::map<std::string, SearchRange> ranges;
  // Radii that shrink from level to level, as all species' do: else silhouettes are filled with wood.
  constexpr double kThickestBranch = 0.03;  // radius over the height of the tree
  const double ratio = seen_ratio(reading);
  const double most =
      std::min(kThickestBranch / std::max(ratio, 0.01), kind == TreeKind::leafless ? 2.0 : 1.2);
  ranges["ratio_power"] = {1, 2.5};
  ranges["radius_mod[1]"] = {0.25 * most, most};
  ranges["radius_mod[2]"] = {0.3, std::max(most, 1.0)};
  ranges["ratio"] = shows_trunk(reading)
                        ? SearchRange{std::max(0.002, 0.5 * ratio), std::clamp(1.3 * ratio, 0.006, 0.15)}
                        : SearchRange{0.005, 0.03};
  if (shows_trunk(reading)) ranges["flare"] = {0, std::max(0.1, seen_flare(reading))};
  ranges["blossom_rate"] = {0, 0};  // a silhouette does not show them
  if (kind == TreeKind::palm) {     // thin ribs, with leaflets that are long and narrow
    ranges["base_size[0]"] = {0.75, 0.98};
    ranges["branches[1]"] = {10, 60};
    ranges["length[1]"] = {0.08, 0.9};
    ranges["radius_mod[1]"] = {0.05, 0.4};
    ranges["leaf_scale"] = {0.015 * height_m, 0.06 * height_m};
    ranges["leaf_scale_x"] = {0.04, 0.16};
    ranges["leaf_blos_num"] = {60, 300};
  }
  if (kind == TreeKind::leafy) {
    constexpr double kLongestLeaf = 0.035;  // of the height: longer ones fill crowns as blobs
    ranges["leaf_scale"] = {0.003 * height_m, kLongestLeaf * height_m};
    ranges["leaf_blos_num"] = {8, 120};
    const double base = lowest_base(reading);
    ranges["base_size[0]"] = {base, std::max(0.6, base + 0.2)};
    ranges["length[1]"] = {0.05, 0.9};
    ranges["length[2]"] = {0.05, 0.7};
    ranges["curve[0]"] = {-30, 30};
    ranges["curve_v[0]"] = {0, 50};
  }
  return ranges;
}

void take_measures(const Model& model, const GrowthBudget& budget, const PictureReading& reading,
                   double height_m, Seed plant_seed, ParameterValues& values) {
  const ParameterTable& table = model.table();
  if (shows_trunk(reading)) {
    set_if_known(table, "ratio", seen_ratio(reading), values);
    set_if_known(table, "flare", seen_flare(reading), values);
    set_if_known(table, "base_size[0]", std::min(reading.crown_base, 0.6), values);
  }
  const auto length = table.find("length[1]");
  const double width_m = grown_width_m(model, budget, plant_seed, values);
  if (!length || width_m <= 0) return;
  const double factor = std::clamp(reading.crown_width * height_m / width_m, 0.4, 2.5);
  set_if_known(table, "length[1]", factor * values[*length], values);
}

}  // namespace espalier
