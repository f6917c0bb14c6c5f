// A model and scorers small enough to reason about: a pole of given height and width.
#pragma once
#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string>

#include <espalier/core/error.h>
#include <espalier/fitting/task/fit_task.h>
#include <espalier/fitting/task/scorer.h>
#include <espalier/plant/model.h>

namespace espalier {

/// The pole model's parameters: height in metres, radius relative to it, and how many stems it says it has.
inline ParameterTable pole_table() {
  const ParameterInfo height{.name = "height",
                             .unit = "m",
                             .lower = 0.1,
                             .upper = 100,
                             .search_lower = 1,
                             .search_upper = 20,
                             .default_value = 10,
                             .free_by_default = true,
                             .choices = {}};
  const ParameterInfo slimness{.name = "radius",
                               .unit = "1",
                               .lower = 0,
                               .upper = 1,
                               .search_lower = 0.01,
                               .search_upper = 0.5,
                               .scale = Scale::logarithmic,
                               .default_value = 0.1,
                               .free_by_default = true,
                               .choices = {}};
  const ParameterInfo stems{.name = "stems",
                            .unit = "1",
                            .lower = 1,
                            .upper = 1e9,
                            .search_lower = 1,
                            .search_upper = 9,
                            .scale = Scale::integer,
                            .default_value = 1,
                            .choices = {}};
  return {"pole", {height, slimness, stems}};
}

/// A single upright stem.
class PoleModel : public Model {
 public:
  const ParameterTable& table() const override { return table_; }
  GrowthEstimate estimate(std::span<const double> values) const override { return {values[2], 0}; }
  GrowthResult generate(std::span<const double> values, Seed seed, const GrowthSettings&,
                        Plant& plant) const override {
    if (values[0] == 13) throw std::runtime_error("thirteen metres");
    if (values[0] == 14) throw InputError("fourteen metres");
    const auto height = static_cast<float>(values[0]) * (1 + 0.1f * static_cast<float>(seed % 5));
    const float radius = height * static_cast<float>(values[1]);
    plant.clear();
    plant.stems.first_knot = {0, 2};
    plant.stems.parent = {-1};
    plant.stems.level = {0};
    plant.stems.path_key = {1};
    plant.stems.origin = {-1};
    plant.stems.child_index = {0};
    plant.knots.point_m = {{0, 0, 0}, {0, 0, height}};
    plant.knots.handle_in_m = {{0, 0, 0}, {0, 0, height * 2 / 3}};
    plant.knots.handle_out_m = {{0, 0, height / 3}, {0, 0, height}};
    plant.knots.radius_m = {radius, radius};
    return {};
  }

 private:
  ParameterTable table_ = pole_table();
};

/// The target is a rectangle 60 px tall and 12 px wide, 10 m tall.
inline FitTask pole_task(const Model& model, std::vector<Seed> seeds = {0}) {
  Mask mask(64, 64);
  for (int y = 2; y < 62; ++y)
    for (int x = 26; x < 38; ++x) mask.set(x, y);
  FitTask task;
  task.model = &model;
  task.growth.budget = {100, 100};
  task.plant_seeds = std::move(seeds);
  task.views.push_back(make_target_view(mask, 60, {}, 10));
  task.objective = parse_objective("iou");
  return task;
}

/// The sum of the values; counts its calls.
struct SumScorer : Scorer {
  long scored = 0;
  void score(std::span<const ParameterValues> candidates, std::span<double> scores) override {
    for (std::size_t i = 0; i < candidates.size(); ++i, ++scored) {
      scores[i] = 0;
      for (const double value : candidates[i]) scores[i] += value;
    }
  }
};

}  // namespace espalier
