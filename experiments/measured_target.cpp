#include "measured_target.h"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>

#include <espalier/core/error.h>
#include <espalier/fitting/record/fit_record.h>
#include <espalier/image/pictures/picture.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>
#include <espalier/render/scanlines/scanline_renderer.h>

namespace espalier {

namespace {

constexpr int kPresetSizePx = 1024;
constexpr Seed kPresetSeed = 1000;
constexpr std::size_t kStarts = 3;

Mask silhouette(const Preset& preset) {
  Plant plant;
  Mask mask;
  measured_model().generate(preset.values, kPresetSeed, {}, plant);
  const Camera camera = frame_bounds(bounds(plant), {}, kPresetSizePx, kPresetSizePx);
  make_scanline_renderer()->draw(plant, camera, mask);
  return mask;
}

}  // namespace

const Model& measured_model() { return model_by_name("weber_penn"); }

MeasuredTarget::MeasuredTarget(const std::string& picture_or_preset) : path_(picture_or_preset) {
  if (std::filesystem::exists(path_)) return;
  const Mask mask = silhouette(load_preset(picture_or_preset));
  path_ = std::filesystem::temp_directory_path() / ("preset_" + picture_or_preset + ".png");
  write_mask_png(path_, mask);
}

FitTask MeasuredTarget::task(int size_px) const {
  const FitRecord defaults;
  const TargetPicture target = read_target(path_, {.size_px = size_px});
  FitTask task;
  task.model = &measured_model();
  task.growth.budget = defaults.growth;
  task.plant_seeds = {defaults.seed};
  task.views.push_back(make_target_view(target.mask, target.tree_height_px, {}, kNominalHeightM));
  task.objective = parse_objective(defaults.objective);
  return task;
}

std::vector<double> SearchBeginning::points() const {
  std::vector<double> points;
  for (std::size_t i = 0; i < std::min(kStarts, starts.size()); ++i) {
    const std::vector<double> point = space.encode(starts[i].values);
    points.insert(points.end(), point.begin(), point.end());
  }
  return points;
}

SearchBeginning begin_search(const FitTask& task, Scorer& scorer) {
  const std::vector<StartPoint> starts = make_start_points(*task.model, StartNames{}, {}, task.growth.budget,
                                                           kNominalHeightM, task.plant_seeds.front());
  std::vector<ParameterValues> candidates;
  candidates.reserve(starts.size());
  for (const StartPoint& start : starts) candidates.push_back(start.values);
  std::vector<double> scores(starts.size());
  scorer.score(candidates, scores);
  std::vector<std::size_t> order(starts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return scores[a] < scores[b]; });
  SearchBeginning beginning;
  for (const std::size_t i : order) beginning.starts.push_back(starts[i]);
  beginning.space = make_search_space(task.model->table(), beginning.starts.front().values, {});
  return beginning;
}

int measure_targets(int argc, char** argv, const std::string& table_head,
                    void (*measure)(const MeasuredTarget&)) {
  try {
    fmt::print("{}\n", table_head);
    for (int i = 1; i < argc; ++i) measure(MeasuredTarget(argv[i]));
  } catch (const InputError& error) {
    fmt::print(stderr, "{}: {}\n", argv[0], error.what());
    return 2;
  }
  return 0;
}

}  // namespace espalier
