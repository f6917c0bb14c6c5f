// The settings of an L-system file: "name: value", with numbers that may be expressions of its constants.
// One row a setting: how many values it takes, their bounds, the field it sets.
#pragma once
#include <array>
#include <memory>
#include <string_view>
#include <vector>

namespace espalier::lsystem {

struct Appearance;  // lsystem/surfaces/appearance.h

/// The settings of a derivation, evaluated.
struct Settings {
  int steps = 1;
  double angle_deg = 90;      ///< of turns without a parameter
  double length = 1;          ///< of segments without a parameter, in units
  double width = 0.1;         ///< of segments, at first: a diameter, in units
  double width_factor = 0.7;  ///< what ! without a parameter multiplies the width by
  double unit_m = 1;          ///< metres of one unit
  std::array<double, 3> tropism{0, 0, 0};
  double susceptibility = 0;  ///< e of [Herbaceous §3]: how far tropism turns a segment
  int leaf_shape = 8, blossom_shape = 1;
  double leaf_length = 1, leaf_width = 1;        ///< of a surface at scale 1, in units
  double joint = 1;                              ///< 1: joints of segments are smooth, 0: they are corners
  bool leafy_segments = false;                   ///< the third to fifth parameters of F and G are leaves
  std::shared_ptr<const Appearance> appearance;  ///< of the grammar
};

using SettingValues = std::array<double, 3>;

struct NotationSetting {
  std::string_view name;
  std::size_t value_count = 1;
  double lower = 0, upper = 0;  ///< of each value
  void (*assign)(Settings&, const SettingValues&) = nullptr;
};

/// In the order of the table.
std::vector<std::string_view> setting_names();

/// nullptr where there is no such setting.
const NotationSetting* find_setting(std::string_view name);

}  // namespace espalier::lsystem
