#include <espalier/experiments/runner/unseen_side.h>
#include <espalier/experiments/runner/unseen_trees.h>
#include <espalier/fitting/task/record_task.h>
#include <espalier/image/reading/frame.h>
#include <espalier/models/grow_preset.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>

namespace espalier {

namespace {

/// The task with the tree itself as its targets, from the front and from the side.
FitTask two_sided_task(const FitRecord& record, const KnownTree& tree) {
  FitRecord read = record;
  FitTask task = make_task(read);
  task.overrides = {};
  const TargetView front = task.views.front();
  const View seen = record.views.front().view;
  TargetView side = front;
  side.camera =
      frame_base({0, 0, 0}, {seen.azimuth_deg + 90, seen.elevation_deg}, front.metres_per_px,
                 front.camera.width_px, front.camera.height_px, base_row_px(front.camera.height_px));
  task.views = {front, side};
  const Plant plant = grow_preset(load_preset(tree.species), tree.species, {.seed = tree.seed});
  const auto renderer = task.make_renderer();
  for (TargetView& view : task.views) {
    Mask mask(view.camera.width_px, view.camera.height_px);
    renderer->draw(plant, view.camera, mask);
    view.target = PreparedTarget(mask);
  }
  return task;
}

/// IoU from the front, then from the side.
std::pair<double, double> ious(FitTask task, Seed seed, const ParameterValues& values,
                               const Overrides& overrides) {
  task.plant_seeds = {seed};
  const std::vector<Mask> masks = draw_candidate(task, values, *task.make_renderer(), overrides);
  return {compare_masks(masks[0], task.views[0].target)["iou"],
          compare_masks(masks[1], task.views[1].target)["iou"]};
}

}  // namespace

SideScores score_sides(const FitRecord& record, const FitResult& result, const KnownTree& tree,
                       int siblings) {
  FitTask task = two_sided_task(record, tree);
  SideScores scores;
  std::tie(scores.front_iou, scores.side_iou) = ious(task, result.seed, result.values, result.overrides);
  FitRecord of_species = record;  // whose model need not be the fit's
  of_species.model = load_preset(tree.species).model;
  task.model = &model_by_name(of_species.model);
  const UnseenTrees species(of_species, siblings);
  const ParameterValues truth = species.truth(tree.species);
  task.growth = {};
  for (const Seed seed : species.seeds()) {
    const auto [front, side] = ious(task, seed, truth, {});
    scores.sibling_front_iou += front / siblings;
    scores.sibling_side_iou += side / siblings;
  }
  return scores;
}

}  // namespace espalier
