#include <algorithm>

#include <espalier/fitting/branches/branch_laying.h>
#include <espalier/fitting/branches/palm_trunk.h>

namespace espalier {

std::map<std::string, double> palm_parameters(const TrunkLine& line, double metres_per_px) {
  constexpr double kMostTaper = 0.8;
  const double length_px = line.length_px();
  return {{"levels", 2},
          {"g_scale", length_px * metres_per_px},
          {"length[0]", 1},
          {"length_v[0]", 0},
          {"ratio", 0.5 * line.foot_width_px / length_px},
          {"radius_mod[0]", 1},
          {"taper[0]", std::clamp(1.0 - line.top_width_px / line.foot_width_px, 0.0, kMostTaper)},
          {"base_splits", 0},
          {"seg_splits[0]", 0},
          {"curve_res[0]", 10},
          {"curve[0]", 0},
          {"curve_back[0]", 0},
          {"curve_v[0]", 0},
          {"bend_v[0]", 0},
          {"tropism_x", 0},
          {"tropism_y", 0}};
}

Overrides lay_palm_trunk(const FitTask& task, const TrunkLine& line, const ParameterValues& values) {
  const Seed seed = task.plant_seeds.front();
  Solution tree{values, seed, {}, 1};
  Draws draws(root_key(seed));
  BranchOffsets trunk = BranchLayer(task, false).lay({line.points, line.foot_width_px, 0}, {0}, tree, draws);
  trunk.at.back() = 0;  // its radius is a parameter
  write_offsets(trunk, tree.overrides);
  return tree.overrides;
}

}  // namespace espalier
