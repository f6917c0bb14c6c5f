// What a fit compares: the target masks with their cameras, the seeds trees are grown with, the
// objective and the growth budget. The target is "a tree H metres tall": H sets the scale of all cameras.
#pragma once
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <espalier/core/random.h>
#include <espalier/fitting/picture/picture_reading.h>
#include <espalier/fitting/record/freedom.h>
#include <espalier/image/measures/compare.h>
#include <espalier/image/measures/objective.h>
#include <espalier/overrides/change_graph.h>
#include <espalier/plant/model.h>
#include <espalier/render/camera.h>
#include <espalier/render/scanlines/scanline_renderer.h>
#include <espalier/render/silhouette.h>

namespace espalier {

/// Height of the target in metres where the user gives none.
inline constexpr double kNominalHeightM = 10;

using RendererFactory = std::function<std::unique_ptr<SilhouetteRenderer>()>;

struct TargetView {
  Camera camera;
  PreparedTarget target;
  float metres_per_px = 0;  ///< in the plane through the base
  PictureReading reading;   ///< what the mask says of its tree
  Mask crown = {};          ///< where leaves are expected; empty: nowhere
  PlantLabels labels = {};  ///< what the picture's colours say
  double confidence = 1;    ///< of how the picture was read, as TargetPicture's
};

/// A target mask whose tree, `tree_height_px` tall with its base at base_row_px, is `height_m` tall. Reads
/// the mask once and for all; throws InputError where it is empty.
TargetView make_target_view(const Mask& mask, float tree_height_px, const View& view, double height_m);

struct FitTask {
  const Model* model = nullptr;  ///< not owned
  GrowthSettings growth;
  std::vector<Seed> plant_seeds;
  std::vector<TargetView> views;
  MaskObjective objective;
  std::shared_ptr<const Volume> envelope;      ///< what growth.prune_to points to, if the tree is trained
  Overrides overrides;                         ///< of every candidate of the search
  std::shared_ptr<const ChangeGraph> changes;  ///< the same, which growth.changes points to
  double bare_wood_price = 0;  ///< in dissimilarity, of leaves and wood that all are in each other's places
  double depth_price = 0;      ///< in dissimilarity, of a plant e times deeper or flatter than species are
  Freedom freedom;             ///< of single branches
  RendererFactory make_renderer = make_scanline_renderer;
  std::vector<std::string> warnings;  ///< what its pictures leave to be desired, a line each
};

/// The silhouettes of one candidate with these overrides instead of the task's: seed by seed, and for each
/// seed view by view. Empty masks where the growth budget refuses the candidate.
std::vector<Mask> draw_candidate(const FitTask& task, const ParameterValues& values,
                                 SilhouetteRenderer& renderer, const Overrides& overrides);

/// Of a candidate of the search.
inline std::vector<Mask> draw_candidate(const FitTask& task, const ParameterValues& values,
                                        SilhouetteRenderer& renderer) {
  return draw_candidate(task, values, renderer, task.overrides);
}

/// What a candidate is searched by, of its silhouettes in all views and of what leaves cover of them: the
/// mean of the objective and, where leaves are expected, of the price for the pixels that only wood covers,
/// and for leaves where the picture shows wood. `leaves` is only looked at in views that expect some. In [0,
/// 1], 0 is best.
double score_of_masks(const FitTask& task, std::span<const Mask> masks, std::span<const Mask> leaves);

/// Whether leaves are drawn apart for it.
bool expects_leaves(const FitTask& task);

/// All metrics, averaged over masks in the order of draw_candidate.
MaskMetrics mean_metrics(const FitTask& task, const std::vector<Mask>& masks);

}  // namespace espalier
