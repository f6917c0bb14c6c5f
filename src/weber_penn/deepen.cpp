// One level at a time; counts after [CH §3.2.1], see deepen.h.
#include <fmt/format.h>

#include <algorithm>

#include <espalier/weber_penn/deepen.h>
#include <espalier/weber_penn/estimate.h>
#include <espalier/weber_penn/table/parameters.h>

namespace espalier {

namespace {

constexpr double kStalkLength = 0.001;  ///< relative to its parent's
constexpr double kOpenTip = 0.98;       ///< taper that leaves a tip wide enough for a fan of stalks

/// The values of one tree by name.
struct NamedValues {
  ParameterValues& values;

  double& operator()(const char* name) const { return values[weber_penn_table().index_of(name)]; }
  double& operator()(const char* name, int level) const {
    return values[weber_penn_table().index_of(fmt::format("{}[{}]", name, level))];
  }
};

/// A straight stem of one segment, bare of nothing, as thick as its parent allows.
void make_stalk(NamedValues value, int level) {
  for (const char* name : {"base_size", "length_v", "seg_splits", "split_angle", "split_angle_v", "curve",
                           "curve_back", "curve_v", "bend_v"})
    value(name, level) = 0;
  for (const char* name : {"curve_res", "taper", "radius_mod"}) value(name, level) = 1;
  value("length", level) = kStalkLength;
}

/// Leaves along a stalk's own direction. Below level 3 there are no values left: leaves are placed by the
/// stalk's.
void point_leaves_along(NamedValues value, int level) {
  if (level > 3) return;
  for (const char* name : {"down_angle", "down_angle_v", "rotate", "rotate_v", "branch_dist"})
    value(name, level) = 0;
}

/// Stalks along the stem, each with about one leaf: at offset z of its parent it bears leaf_blos_num·(1 - 0.7
/// z).
void move_leaves_along(NamedValues value, int parent_level) {
  value("branches", parent_level + 1) = value("leaf_blos_num");
  value("leaf_blos_num") = 1 / 0.65;
}

/// A fan of stalks at the tip, where z = 1; the tip must not end in a point, on which no stem grows.
void move_leaf_fan(NamedValues value, int parent_level) {
  double& taper = value("taper", parent_level);
  taper = std::min(taper < 1 ? taper : std::max(0.0, 2 - taper), kOpenTip);
  value("branches", parent_level + 1) = value("leaf_blos_num");
  value("leaf_blos_num") = 1 / 0.3;
}

double expected_leaves(const ParameterValues& values) {
  return estimate_growth(weber_penn_parameters(values)).leaves;
}

/// Splitting stems bear leaves and stems at different rates: as many stalks as it takes to expect as many
/// leaves.
void add_level(NamedValues value) {
  const double leaves = expected_leaves(value.values);
  const int stalk_level = static_cast<int>(value("levels"));
  make_stalk(value, stalk_level);
  point_leaves_along(value, stalk_level + 1);
  value("leaf_blos_num") < 0 ? move_leaf_fan(value, stalk_level - 1)
                             : move_leaves_along(value, stalk_level - 1);
  value("relaxed_counts") = 1;
  value("levels") += 1;
  const double leaves_on_stalks = expected_leaves(value.values);
  double& stalks = value("branches", stalk_level);
  if (leaves_on_stalks > 0) stalks = std::clamp(stalks * leaves / leaves_on_stalks, -1000.0, 1000.0);
}

}  // namespace

ParameterValues deepened_values(std::span<const double> values, int levels) {
  ParameterValues deep(values.begin(), values.end());
  const NamedValues value{deep};
  while (value("levels") < std::min(levels, 4)) add_level(value);
  return deep;
}

}  // namespace espalier
