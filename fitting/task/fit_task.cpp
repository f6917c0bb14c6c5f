#include <algorithm>
#include <bit>
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

namespace {

std::size_t bits_of(std::uint64_t word) { return static_cast<std::size_t>(std::popcount(word)); }

/// Share of the pixels in which leaves or wood are expected that show the other.
double misplaced_share(const TargetView& view, const Mask& mask, const Mask& leaves) {
  const Mask& crown = view.crown;
  const Mask& wood = view.labels.wood;
  std::size_t misplaced = 0;
  for (std::size_t i = 0; i < crown.words().size(); ++i)
    misplaced += bits_of(crown.words()[i] & mask.words()[i] & ~leaves.words()[i]);
  for (std::size_t i = 0; i < wood.words().size(); ++i)
    misplaced += bits_of(wood.words()[i] & leaves.words()[i]);
  return static_cast<double>(misplaced) / static_cast<double>(area_px(crown) + area_px(wood));
}

}  // namespace

double score_of_masks(const FitTask& task, std::span<const Mask> masks, std::span<const Mask> leaves) {
  double sum = 0;
  for (std::size_t i = 0; i < masks.size(); ++i) {
    const TargetView& view = task.views[i];
    double score = dissimilarity(task.objective, masks[i], view.target);
    if (task.bare_wood_price > 0 && area_px(view.crown) > 0)
      score = std::min(1.0, score + task.bare_wood_price * misplaced_share(view, masks[i], leaves[i]));
    sum += score;
  }
  return sum / static_cast<double>(masks.size());
}

bool expects_leaves(const FitTask& task) {
  return task.bare_wood_price > 0 &&
         std::any_of(task.views.begin(), task.views.end(),
                     [](const TargetView& view) { return area_px(view.crown) > 0; });
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
