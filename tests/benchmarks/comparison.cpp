// What comparing a candidate's mask with a target costs: each measure a search minimises, on the silhouettes
// of two quaking aspens of different seeds. One thread.
//   build/bin/bench_comparison
#include <benchmark/benchmark.h>

#include <string>

#include <espalier/image/measures/objective.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>
#include <espalier/render/scanlines/scanline_renderer.h>
#include <espalier/render/silhouette.h>

namespace espalier {
namespace {

struct MaskPair {
  Mask candidate, target;
};

MaskPair two_aspens(int size_px) {
  const Preset preset = load_preset("quaking_aspen");
  const Model& model = model_by_name(preset.model);
  const auto renderer = make_scanline_renderer();
  Plant plant;
  MaskPair masks;
  model.generate(preset.values, 1, {}, plant);
  const Camera camera = frame_bounds(bounds(plant), {}, size_px, size_px);
  renderer->draw(plant, camera, masks.target);
  model.generate(preset.values, 2, {}, plant);
  renderer->draw(plant, camera, masks.candidate);
  return masks;
}

void compare(benchmark::State& state, const std::string& objective_text, int size_px) {
  const MaskPair masks = two_aspens(size_px);
  const PreparedTarget target(masks.target);
  const MaskObjective objective = parse_objective(objective_text);
  double value = 0;
  for (auto _ : state) benchmark::DoNotOptimize(value = dissimilarity(objective, masks.candidate, target));
  state.counters["dissimilarity"] = value;
}

bool add_all() {
  for (const std::string objective : {"iou", "truncated_distance", "0.5*truncated_distance+0.5*iou"})
    for (const int size_px : {128, 256, 512})
      benchmark::RegisterBenchmark((objective + "/" + std::to_string(size_px)).c_str(),
                                   [=](benchmark::State& state) { compare(state, objective, size_px); })
          ->Unit(benchmark::kMicrosecond);
  return true;
}

const bool kAdded = add_all();

}  // namespace
}  // namespace espalier
