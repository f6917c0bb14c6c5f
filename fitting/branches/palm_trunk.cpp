#include <algorithm>

#include <espalier/fitting/branches/branch_laying.h>
#include <espalier/fitting/branches/palm_trunk.h>

namespace espalier {

bool can_hold_trunks(const Model& model) {
  const ParameterTable& table = model.table();
  return model.has_branch_paths() && table.find(Role::tree_scale) && table.find(Role::trunk_ratio) &&
         !table.find(Role::length_unit);
}

std::map<std::string, double> palm_parameters(const ParameterTable& table, const TrunkLine& line,
                                              double metres_per_px) {
  constexpr double kMostTaper = 0.8;
  const double length_px = line.length_px();
  std::map<std::string, double> values;
  const auto set = [&values](const ParameterInfo& row, double value) {
    values[row.full_name()] = std::clamp(value, row.lower, row.upper);
  };
  const auto set_role = [&](Role role, double value) {
    if (const auto row = table.find(role)) set(table.rows[*row], value);
  };
  for (const ParameterInfo& row : table.rows)
    if (row.role.role == Role::trunk_form && row.plain) set(row, *row.plain);
  set_role(Role::levels, 2);
  set_role(Role::tree_scale, length_px * metres_per_px);
  set_role(Role::trunk_ratio, 0.5 * line.foot_width_px / length_px);
  set_role(Role::trunk_taper, std::clamp(1.0 - line.top_width_px / line.foot_width_px, 0.0, kMostTaper));
  set_role(Role::trunk_segments, 10);
  set_role(Role::trunk_bend, 0);
  set_role(Role::trunk_bend_variation, 0);
  return values;
}

Overrides lay_palm_trunk(const FitTask& task, const TrunkLine& line, const ParameterValues& values) {
  const Seed seed = task.plant_seeds.front();
  Solution tree{values, seed, {}, 1};
  // Its radius is a parameter.
  write_offsets(BranchLayer(task).lay({line.points, {}, {}}, {0}, tree).offsets, tree.overrides);
  return tree.overrides;
}

}  // namespace espalier
