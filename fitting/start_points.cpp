#include "fitting/start_points.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/error.h"
#include "models/preset.h"

namespace espalier {

namespace {

constexpr int kThinningSteps = 12;

void set_if_known(const ParameterTable& table, const std::string& name, double value,
                  ParameterValues& values) {
  if (const auto row = table.find(name)) values[*row] = value;
}

/// Scales a count towards zero, to a whole number unless that is nothing.
void thin_count(const ParameterTable& table, const std::string& name, double factor,
                ParameterValues& values) {
  const auto row = table.find(name);
  if (!row || values[*row] == 0) return;
  const double thinned = std::trunc(values[*row] * factor);
  values[*row] = thinned == 0 ? std::copysign(1.0, values[*row]) : thinned;
}

/// Fewer leaves, as much larger: together they cover the same area.
void thin_leaves(const ParameterTable& table, double factor, ParameterValues& values) {
  const auto count = table.find("leaf_blos_num"), scale = table.find("leaf_scale");
  const double before = count ? values[*count] : 0;
  thin_count(table, "leaf_blos_num", factor, values);
  if (scale && before != 0)
    values[*scale] = std::min(values[*scale] * std::sqrt(before / values[*count]), table.rows[*scale].upper);
}

/// "branches[2]" for a tree of three levels, or the next level down towards the trunk that is not yet 1.
std::string deepest_branches(const ParameterTable& table, const ParameterValues& values) {
  const auto levels = table.find("levels");
  int deepest = std::clamp(levels ? static_cast<int>(values[*levels]) - 1 : 0, 1, 3);
  for (; deepest > 1; --deepest) {
    const auto row = table.find(fmt::format("branches[{}]", deepest));
    if (row && std::fabs(values[*row]) > 1) break;
  }
  return fmt::format("branches[{}]", deepest);
}

bool has_leaves(const ParameterTable& table, const ParameterValues& values) {
  const auto row = table.find("leaf_blos_num");
  return row && values[*row] != 0;
}

std::vector<std::string> split_at_commas(const std::string& text) {
  std::vector<std::string> parts;
  std::stringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');)
    if (!part.empty()) parts.push_back(part);
  return parts;
}

/// Presets by `start`, as they are written.
std::vector<StartPoint> load_starts(const ParameterTable& table, const std::string& start) {
  std::vector<StartPoint> points;
  const bool automatic = start == "auto";
  for (const std::string& name : automatic ? bundled_presets() : split_at_commas(start)) {
    Preset preset = load_preset(name);
    if (preset.model == table.model)
      points.push_back({preset.name, std::move(preset.values)});
    else if (!automatic)
      throw_input_error("--start: got '{}' of model {}, expected a preset of {}", name, preset.model,
                        table.model);
  }
  if (points.empty()) points.push_back({"defaults", table.defaults()});
  return points;
}

/// The estimate is a mean: thins on until this seed's plant is within the budget too, if a few steps get
/// there.
void thin_until_grown(const Model& model, GrowthBudget budget, Seed seed, ParameterValues& values) {
  constexpr int kSteps = 6;
  const GrowthSettings settings{budget, nullptr};
  Plant plant;
  for (int step = 0; step < kSteps; ++step) {
    thin_to_budget(model, budget, values);
    if (model.generate(values, seed, settings, plant).grown) return;
    budget.max_stems *= 0.7;
    budget.max_leaves *= 0.7;
  }
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

}  // namespace

void scale_plant(const ParameterTable& table, double factor, ParameterValues& values) {
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (table.rows[i].unit == "m")
      values[i] = std::clamp(values[i] * factor, table.rows[i].lower, table.rows[i].upper);
}

void thin_to_budget(const Model& model, const GrowthBudget& budget, ParameterValues& values) {
  const ParameterTable& table = model.table();
  for (int step = 0; step < kThinningSteps; ++step) {
    const GrowthEstimate estimate = model.estimate(values);
    const double stem_factor = 0.9 * budget.max_stems / std::max(estimate.stems, 1.0);
    const double leaf_factor = 0.9 * budget.max_leaves / std::max(estimate.leaves, 1.0);
    if (estimate.stems <= budget.max_stems && estimate.leaves <= budget.max_leaves) return;
    if (estimate.stems > budget.max_stems)
      thin_count(table, deepest_branches(table, values), stem_factor, values);
    else
      thin_leaves(table, leaf_factor, values);
  }
}

std::vector<StartPoint> make_start_points(const Model& model, const std::string& start,
                                          const SearchChoice& choice, const GrowthBudget& budget,
                                          double height_m, Seed plant_seed) {
  const ParameterTable& table = model.table();
  std::vector<StartPoint> points = start == "defaults"
                                       ? std::vector<StartPoint>{{"defaults", table.defaults()}}
                                       : load_starts(table, start);
  const std::size_t presets = points.size();
  for (std::size_t i = 0; i < presets; ++i) {
    set_if_known(table, "g_scale_v", 0, points[i].values);
    set_if_known(table, "relaxed_counts", 1, points[i].values);
    thin_until_grown(model, budget, plant_seed, points[i].values);
    scale_to_height(model, budget, height_m, plant_seed, points[i].values);
    if (has_leaves(table, points[i].values)) {
      points.push_back({points[i].name + " without leaves", points[i].values});
      set_if_known(table, "leaf_blos_num", 0, points.back().values);
    }
  }
  for (StartPoint& point : points) apply_fixed(table, choice, point.values);
  return points;
}

}  // namespace espalier
