#include <algorithm>
#include <cmath>
#include <optional>

#include <espalier/core/field_error.h>
#include <espalier/fitting/starts/random_starts.h>
#include <espalier/fitting/starts/start_points.h>
#include <espalier/fitting/starts/thinning.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>

namespace espalier {

namespace {

/// The bundled presets but for those to leave out. Throws FieldError for a name that none of them has.
std::vector<std::string> bundled_without(const std::vector<std::string>& left_out) {
  std::vector<std::string> names = bundled_presets();
  for (const std::string& name : left_out)
    if (std::erase(names, name) == 0)
      throw_field_error("start", "got '-{}', expected a bundled preset to leave out", name);
  return names;
}

/// The height of the grown plant above its base, or 0 where it does not grow.
double grown_height_m(const Model& model, const GrowthSettings& settings, const ParameterValues& values,
                      Seed seed) {
  Plant plant;
  if (!model.generate(values, seed, settings, plant).grown) return 0;
  return bounds(plant).upper.z;
}

/// Twice, because the smallest radii of the model do not scale.
void scale_to_height(const Model& model, const GrowthBudget& budget, double height_m, Seed seed,
                     ParameterValues& values) {
  for (int pass = 0; pass < 2; ++pass) {
    const double grown_m = grown_height_m(model, {budget, nullptr}, values, seed);
    if (grown_m > 0) scale_plant(model.table(), height_m / grown_m, values);
  }
}

/// The count of leaves, where it may be none.
std::optional<std::size_t> leaves_row(const ParameterTable& table) {
  const auto row = table.find(Role::leaf_count);
  return row && table.rows[*row].lower <= 0 ? row : std::nullopt;
}

}  // namespace

std::vector<StartPoint> presets_as_written(const ParameterTable& table, const StartNames& start) {
  if (start.source == StartSource::defaults) return {{"defaults", table.defaults()}};
  if (start.source == StartSource::random) return {};
  std::vector<StartPoint> points;
  const bool are_named = start.source == StartSource::named;
  for (const std::string& name : are_named ? start.presets : bundled_without(start.left_out)) {
    Preset preset = in_field("start", [&] { return load_preset(name); });
    if (is_same_model(preset.model, table.model))
      points.push_back({preset.name, std::move(preset.values), std::move(preset.overrides)});
    else if (are_named)
      throw_field_error("start", "got '{}' of model {}, expected a preset of {}", name, preset.model,
                        table.model);
  }
  if (points.empty()) points.push_back({"defaults", table.defaults()});
  return points;
}

void prepare_start(const Model& model, const GrowthBudget& budget, double height_m, Seed plant_seed,
                   ParameterValues& values) {
  set_role(model.table(), {Role::tree_scale_variation}, 0, values);
  set_role(model.table(), {Role::relaxed_counts}, 1, values);
  thin_until_grown(model, budget, plant_seed, values);
  scale_to_height(model, budget, height_m, plant_seed, values);
}

bool has_leaves(const ParameterTable& table, const ParameterValues& values) {
  const auto row = leaves_row(table);
  return row && values[*row] != 0;
}

void take_leaves(const ParameterTable& table, ParameterValues& values) {
  if (const auto row = leaves_row(table)) values[*row] = 0;
}

std::vector<StartPoint> make_start_points(const Model& model, const StartNames& start,
                                          const SearchChoice& choice, const GrowthBudget& budget,
                                          double height_m, Seed plant_seed) {
  if (start.source == StartSource::random)
    return random_starts(model, start.draws, choice, budget, height_m, plant_seed);
  const ParameterTable& table = model.table();
  std::vector<StartPoint> points = presets_as_written(table, start);
  const std::size_t presets = points.size();
  for (std::size_t i = 0; i < presets; ++i) {
    prepare_start(model, budget, height_m, plant_seed, points[i].values);
    if (has_leaves(table, points[i].values)) {
      points.push_back({points[i].name + " without leaves", points[i].values});
      take_leaves(table, points.back().values);
    }
  }
  for (StartPoint& point : points) {
    point.has_own_crown = model.uses_crown(point.values);
    apply_fixed(table, choice, point.values);
  }
  return points;
}

}  // namespace espalier
