// Seasons: one row each. Colours are linear RGB.
#include <algorithm>
#include <array>

#include <espalier/core/error.h>
#include <espalier/render/shading/materials.h>
#include <espalier/render/shading/seasons.h>

namespace espalier {

namespace {

struct Season {
  const char* name;
  bool has_leaves;
  LinearRgb leaf, leaf_through;
};

constexpr ShadedSettings kUsual{};
constexpr std::array<Season, 4> kSeasons{{
    {"summer", true, kUsual.leaf, kUsual.leaf_through},
    {"autumn", true, {0.42f, 0.20f, 0.025f}, {0.45f, 0.20f, 0.015f}},
    {"winter", false, kUsual.leaf, kUsual.leaf_through},
    {"spring", true, {0.12f, 0.22f, 0.045f}, {0.15f, 0.26f, 0.03f}},
}};

const Season& season_of(const std::string& name) {
  const auto* season =
      std::find_if(kSeasons.begin(), kSeasons.end(), [&](const Season& s) { return s.name == name; });
  if (season == kSeasons.end())
    throw_input_error("got '{}', expected one of: {}", name, fmt::join(season_names(), ", "));
  return *season;
}

/// Leaves let through what they reflect, more of its red and green.
void set_leaf(PartColor color, ShadedSettings& settings) {
  constexpr LinearRgb kThrough{1.25f, 1.2f, 0.7f};
  settings.leaf = to_linear(color);
  settings.leaf_through = {kThrough.x * settings.leaf.x, kThrough.y * settings.leaf.y,
                           kThrough.z * settings.leaf.z};
}

}  // namespace

void apply_colors(const PlantColors& colors, const std::string& season, ShadedSettings& settings) {
  if (colors.bark.is_set) settings.bark = to_linear(colors.bark);
  if (season == "autumn") {
    if (colors.autumn.is_set) set_leaf(colors.autumn, settings);
  } else if (season != "spring" && colors.leaf.is_set) {
    set_leaf(colors.leaf, settings);
  }
}

std::vector<std::string> season_names() {
  std::vector<std::string> names;
  names.reserve(kSeasons.size());
  for (const Season& season : kSeasons) names.emplace_back(season.name);
  return names;
}

void check_season(const std::string& name) { season_of(name); }

void apply_season(const std::string& name, Plant& plant, ShadedSettings& settings) {
  const Season& season = season_of(name);
  settings.leaf = season.leaf;
  settings.leaf_through = season.leaf_through;
  if (!season.has_leaves) plant.leaves = {};
}

}  // namespace espalier
