#include <algorithm>
#include <cmath>
#include <numbers>

#include <espalier/fitting/task/fit_task.h>
#include <espalier/image/reading/frame.h>
#include <espalier/overrides/change_graph.h>

namespace espalier {

TargetView make_target_view(const Mask& mask, float tree_height_px, const View& view, double height_m) {
  // Seen from above or below, an upright tree is foreshortened; past 60 degrees its width sets its height.
  const double elevation = std::fabs(view.elevation_deg) * std::numbers::pi / 180;
  const double seen_height_m = height_m * std::max(0.5, std::cos(elevation));
  const auto metres_per_px = static_cast<float>(seen_height_m / tree_height_px);
  const int size_px = mask.width_px();
  return {frame_base({0, 0, 0}, view, metres_per_px, size_px, size_px, base_row_px(size_px)),
          PreparedTarget(mask), metres_per_px, read_picture(mask)};
}

std::vector<Mask> draw_candidate(const FitTask& task, const ParameterValues& values,
                                 SilhouetteRenderer& renderer, const Overrides& overrides) {
  std::vector<Mask> masks;
  Plant plant;
  const ChangeGraph changes(overrides);
  GrowthSettings growth = task.growth;
  growth.changes = &changes;
  for (const Seed seed : task.plant_seeds) {
    plant.clear();
    const bool grown = task.model->generate(values, seed, growth, plant).grown;
    for (const TargetView& view : task.views) {
      masks.emplace_back(view.camera.width_px, view.camera.height_px);
      if (grown) renderer.draw(plant, view.camera, masks.back());
    }
  }
  return masks;
}

MaskMetrics mean_metrics(const FitTask& task, const std::vector<Mask>& masks) {
  MaskMetrics mean;
  const double weight = 1.0 / static_cast<double>(masks.size());
  for (std::size_t i = 0; i < masks.size(); ++i) {
    const MaskMetrics one = compare_masks(masks[i], task.views[i % task.views.size()].target);
    for (std::size_t row = 0; row < kMetricCount; ++row) mean.values[row] += weight * one.values[row];
  }
  return mean;
}

}  // namespace espalier
