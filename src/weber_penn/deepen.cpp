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
  /// The numbers of a curve.
  std::span<double> curve(const std::string& full_name) const {
    return std::span(values).subspan(info(full_name).first_row, kCurveRows);
  }
  void make_neutral(const std::string& full_name) const {
    std::ranges::fill(curve(full_name), info(full_name).neutral);
  }

 private:
  static const CurveInfo& info(const std::string& full_name) {
    return *weber_penn_table().find_curve(full_name);
  }
};

/// A straight stem of one segment, bare of nothing, as thick as its parent allows.
void make_stalk(NamedValues value, int level) {
  for (const char* name : {"base_size", "length_v", "seg_splits", "split_angle", "split_angle_v", "curve",
                           "curve_back", "curve_v", "bend_v"})
    value(name, level) = 0;
  for (const char* name : {"curve_res", "taper", "radius_mod"}) value(name, level) = 1;
  for (const char* name : {"length_along", "curve_along", "bend_along", "radius_along"})
    value.make_neutral(fmt::format("{}[{}]", name, level));
  value("length", level) = kStalkLength;
}

/// Leaves along a stalk's own direction. Below level 3 there are no values left: leaves are placed by the
/// stalk's.
void point_leaves_along(NamedValues value, int level) {
  if (level > 3) return;
  for (const char* name : {"down_angle", "down_angle_v", "rotate", "rotate_v", "branch_dist"})
    value(name, level) = 0;
  value.make_neutral(fmt::format("down_angle_along[{}]", level));
}

/// The mean of each B-spline is the width of its support over its order (de Boor, ch. IX).
double mean_of_curve(std::span<const double> numbers) {
  constexpr double kWidths[kCurveRows] = {1, 2, 3, 4, 3, 2, 1};
  double sum = 0;
  for (std::size_t i = 0; i < kCurveRows; ++i) sum += kWidths[i] * numbers[i];
  return sum / 16;
}

/// Stalks spread as the leaves did. How large leaves are along a stem, a stalk cannot say: they keep their
/// mean size.
void move_leaf_curves(NamedValues value, int level) {
  std::ranges::copy(value.curve("leaf_density_along"),
                    value.curve(fmt::format("density_along[{}]", level)).begin());
  value.make_neutral("leaf_density_along");
  const auto sizes = value.curve("leaf_scale_along");
  if (!std::ranges::all_of(sizes, [](double size) { return size == 1; }))
    for (const char* name : {"leaf_scale", "blossom_scale"}) value(name) *= mean_of_curve(sizes);
  value.make_neutral("leaf_scale_along");
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
  move_leaf_curves(value, stalk_level);
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
