#include "lsystem/settings.h"

#include "core/error.h"

namespace espalier::lsystem {

namespace {

constexpr double kLarge = 1e6;

constexpr std::array<SettingInfo, 13> kSettings{{
    {"steps", 1, {1}, 0, 10'000, "derivation steps"},
    {"angle", 1, {90}, -3600, 3600, "degrees of a turn without a parameter"},
    {"length", 1, {1}, 0, kLarge, "units of a segment without a parameter"},
    {"width", 1, {0.1}, 0, kLarge, "diameter of the first segments, in units"},
    {"width_factor", 1, {0.7}, 0, 1, "what ! multiplies the width by"},
    {"unit", 1, {1}, 1e-6, kLarge, "metres of one unit"},
    {"tropism", 3, {0, 0, 0}, -kLarge, kLarge, "the vector T that segments turn towards"},
    {"susceptibility", 1, {0}, -100, 100, "e: how much they turn"},
    {"leaf_shape", 1, {8}, 0, 10, "outline of leaves, as in the parametric model"},
    {"blossom_shape", 1, {1}, 1, 3, "outline of blossoms"},
    {"leaf_length", 1, {1}, 0, kLarge, "units of a leaf at scale 1"},
    {"leaf_width", 1, {1}, 0, kLarge, "units across the outline at scale 1"},
    {"joint", 1, {1}, 0, 1, "1 where segments join smoothly, 0 for corners"},
}};

}  // namespace

const SettingInfo* find_setting(std::string_view name) {
  for (const SettingInfo& info : kSettings)
    if (info.name == name) return &info;
  return nullptr;
}

void assign_setting(Settings& settings, std::string_view name, const std::array<double, 3>& values) {
  const double value = values[0];
  if (name == "steps")
    settings.steps = static_cast<int>(value);
  else if (name == "angle")
    settings.angle_deg = value;
  else if (name == "length")
    settings.length = value;
  else if (name == "width")
    settings.width = value;
  else if (name == "width_factor")
    settings.width_factor = value;
  else if (name == "unit")
    settings.unit_m = value;
  else if (name == "tropism")
    settings.tropism = values;
  else if (name == "susceptibility")
    settings.susceptibility = value;
  else if (name == "leaf_shape")
    settings.leaf_shape = static_cast<int>(value);
  else if (name == "blossom_shape")
    settings.blossom_shape = static_cast<int>(value);
  else if (name == "leaf_length")
    settings.leaf_length = value;
  else if (name == "leaf_width")
    settings.leaf_width = value;
  else if (name == "joint")
    settings.joint = value;
  else
    throw InternalError(fmt::format("setting '{}' has a row but no field", name));
}

}  // namespace espalier::lsystem
