// What one evaluation of a fit costs, part by part: generate, draw (by Embree: build the scene, trace the
// mask; by scan lines: scan), compare with a target, and all of them, also without leaves. One thread, whole
// plant in the frame, a new seed each time.
//   build/bin/bench_evaluation --benchmark_filter=quaking_aspen
#include <benchmark/benchmark.h>

#include <array>
#include <string>
#include <vector>

#include <espalier/image/measures/compare.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>
#include <espalier/render/embree/embree_renderer.h>
#include <espalier/render/embree/embree_scene.h>
#include <espalier/render/grow_and_draw.h>
#include <espalier/render/scanlines/scanline_renderer.h>

namespace espalier {
namespace {

/// A species with everything that stays the same from one evaluation to the next.
struct Setting {
  Preset preset;
  const Model& model;
  Camera camera;
  Mask target;

  Setting(const std::string& species, int size_px, bool leaves = true)
      : preset(load_preset(species)), model(model_by_name(preset.model)) {
    if (!leaves) preset.values[*model.table().find("leaf_blos_num")] = 0;
    const Plant plant = grown(1000);
    camera = frame_bounds(bounds(plant), {}, size_px, size_px);
    EmbreeScene scene;
    scene.build(plant, stem_tolerance_m(plant, camera));
    scene.trace(camera, target);
  }

  void grow(Seed seed, Plant& plant) const { model.generate(preset.values, seed, {}, plant); }

  Plant grown(Seed seed) const {
    Plant plant;
    grow(seed, plant);
    return plant;
  }
};

void count_plant(benchmark::State& state, const Plant& plant) {
  state.counters["knots"] = static_cast<double>(plant.knots.size());
  state.counters["leaves"] = static_cast<double>(plant.leaves.size());
}

void generate(benchmark::State& state, const std::string& species) {
  const Setting setting(species, 256);
  Plant plant;
  Seed seed = 0;
  for (auto _ : state) setting.grow(++seed, plant);
  count_plant(state, plant);
}

void build(benchmark::State& state, const std::string& species, int size_px) {
  const Setting setting(species, size_px);
  const Plant plant = setting.grown(1);
  EmbreeScene scene;
  for (auto _ : state) scene.build(plant, stem_tolerance_m(plant, setting.camera));
  state.counters["cones"] = static_cast<double>(scene.stems().size());
}

void trace(benchmark::State& state, const std::string& species, int size_px) {
  const Setting setting(species, size_px);
  const Plant plant = setting.grown(1);
  EmbreeScene scene;
  scene.build(plant, stem_tolerance_m(plant, setting.camera));
  Mask mask;
  for (auto _ : state) scene.trace(setting.camera, mask);
  state.counters["px"] = static_cast<double>(area_px(mask));
}

void compare(benchmark::State& state, const std::string& species, int size_px) {
  const Setting setting(species, size_px);
  const Plant plant = setting.grown(1);
  EmbreeScene scene;
  Mask mask;
  scene.build(plant, stem_tolerance_m(plant, setting.camera));
  scene.trace(setting.camera, mask);
  for (auto _ : state) benchmark::DoNotOptimize(iou(mask, setting.target));
}

void scan(benchmark::State& state, const std::string& species, int size_px) {
  const Setting setting(species, size_px);
  const Plant plant = setting.grown(1);
  const auto renderer = make_scanline_renderer();
  Mask mask;
  for (auto _ : state) renderer->draw(plant, setting.camera, mask);
  state.counters["px"] = static_cast<double>(area_px(mask));
}

void evaluate_with(SilhouetteRenderer& renderer, benchmark::State& state, const Setting& setting) {
  Plant plant;
  Mask mask;
  const std::array pictures{SilhouetteView{&setting.camera, &mask}};
  Seed seed = 0;
  for (auto _ : state) {
    grow_and_draw(setting.model, setting.preset.values, ++seed, {}, renderer, pictures, plant);
    benchmark::DoNotOptimize(iou(mask, setting.target));
  }
  state.SetItemsProcessed(state.iterations());
}

void evaluate_embree(benchmark::State& state, const std::string& species, int size_px) {
  evaluate_with(*make_embree_renderer(), state, {species, size_px});
}

void evaluate_scanline(benchmark::State& state, const std::string& species, int size_px) {
  evaluate_with(*make_scanline_renderer(), state, {species, size_px});
}

void evaluate_bare(benchmark::State& state, const std::string& species, int size_px) {
  evaluate_with(*make_scanline_renderer(), state, {species, size_px, false});
}

using Part = void (*)(benchmark::State&, const std::string&, int);

void add(const std::string& part, Part run, const std::string& species, int size_px) {
  const std::string name = species + "/" + part + "/" + std::to_string(size_px);
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
    run(state, species, size_px);
  })->Unit(benchmark::kMillisecond);
}

bool add_all() {
  for (const std::string species :
       {"quaking_aspen", "lombardy_poplar", "small_pine", "palm", "weeping_willow"}) {
    const std::string name = species + "/generate";
    benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
      generate(state, species);
    })->Unit(benchmark::kMillisecond);
    const auto sizes_px = species == "quaking_aspen" ? std::vector{128, 256, 512} : std::vector{256};
    for (const int size_px : sizes_px) {
      add("build", build, species, size_px);
      add("trace", trace, species, size_px);
      add("compare", compare, species, size_px);
      add("scan", scan, species, size_px);
      add("evaluate_embree", evaluate_embree, species, size_px);
      add("evaluate_scanline", evaluate_scanline, species, size_px);
      add("evaluate_bare", evaluate_bare, species, size_px);
    }
  }
  return true;
}

const bool kAdded = add_all();

}  // namespace
}  // namespace espalier
