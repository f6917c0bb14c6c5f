#include <espalier/lsystem/notation/settings.h>
#include <espalier/plant/leaf_outlines.h>

namespace espalier::lsystem {

namespace {

constexpr double kLarge = 1e6;

using Values = SettingValues;

constexpr std::array<NotationSetting, 13> kSettings{{
    {"steps", 1, 0, 10'000, [](Settings& s, const Values& v) { s.steps = static_cast<int>(v[0]); }},
    {"angle", 1, -3600, 3600, [](Settings& s, const Values& v) { s.angle_deg = v[0]; }},
    {"length", 1, 0, kLarge, [](Settings& s, const Values& v) { s.length = v[0]; }},
    {"width", 1, 0, kLarge, [](Settings& s, const Values& v) { s.width = v[0]; }},
    {"width_factor", 1, 0.01, 1, [](Settings& s, const Values& v) { s.width_factor = v[0]; }},
    {"unit", 1, 1e-6, kLarge, [](Settings& s, const Values& v) { s.unit_m = v[0]; }},
    {"tropism", 3, -kLarge, kLarge, [](Settings& s, const Values& v) { s.tropism = v; }},
    {"susceptibility", 1, -100, 100, [](Settings& s, const Values& v) { s.susceptibility = v[0]; }},
    {"leaf_shape", 1, 0, kLeafShapes.size(),
     [](Settings& s, const Values& v) { s.leaf_shape = static_cast<int>(v[0]); }},
    {"blossom_shape", 1, 1, kBlossomShapes.size(),
     [](Settings& s, const Values& v) { s.blossom_shape = static_cast<int>(v[0]); }},
    {"leaf_length", 1, 0, kLarge, [](Settings& s, const Values& v) { s.leaf_length = v[0]; }},
    {"leaf_width", 1, 0, kLarge, [](Settings& s, const Values& v) { s.leaf_width = v[0]; }},
    {"joint", 1, 0, 1, [](Settings& s, const Values& v) { s.joint = v[0]; }},
}};

}  // namespace

std::vector<std::string_view> setting_names() {
  std::vector<std::string_view> names;
  names.reserve(kSettings.size());
  for (const NotationSetting& info : kSettings) names.push_back(info.name);
  return names;
}

const NotationSetting* find_setting(std::string_view name) {
  for (const NotationSetting& info : kSettings)
    if (info.name == name) return &info;
  return nullptr;
}

}  // namespace espalier::lsystem
