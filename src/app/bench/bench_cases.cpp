#include <omp.h>

#include <array>
#include <chrono>

#include <espalier/app/bench/bench_cases.h>
#include <espalier/image/measures/compare.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>
#include <espalier/render/embree/embree_renderer.h>
#include <espalier/render/grow_and_draw.h>
#include <espalier/render/scanlines/scanline_renderer.h>

namespace espalier {

namespace {

using Clock = std::chrono::steady_clock;

constexpr Seed kTargetSeed = 1000;

double seconds_between(Clock::time_point a, Clock::time_point b) {
  return std::chrono::duration<double>(b - a).count();
}

/// What all evaluations of a case share.
struct Setting {
  Preset preset;
  const Model& model;
  bool has_leaves;
  Camera camera;
  Mask target;

  explicit Setting(const BenchCase& of)
      : preset(load_preset(of.species)), model(model_by_name(preset.model)), has_leaves(of.leaves) {
    for (const auto& [role, value] : of.changes) set_role(model.table(), role, value, preset.values);
    if (!of.leaves) set_role(model.table(), {Role::leaf_count}, 0, preset.values);
    Plant plant;
    model.generate(preset.values, kTargetSeed, {}, plant);
    camera = frame_bounds(bounds(plant), {}, of.size_px, of.size_px);
    make_scanline_renderer()->draw(plant, camera, target);
  }
};

/// The scan-line renderer, which tells how long it drew, also while the plant grew, and how many leaves.
class TimedRenderer : public SilhouetteRenderer, private SilhouetteParts {
 public:
  void draw(const Plant& plant, const Camera& camera, Mask& mask) override {
    mask.reset(camera.width_px, camera.height_px);
    add_plant(plant, camera, mask, nullptr);
  }
  SilhouetteParts* parts() override { return this; }

  double seconds = 0, leaves = 0;

 private:
  void add_leaves(const LeafColumns& some, const Camera& camera, Mask& mask) override {
    const auto began = Clock::now();
    renderer_->parts()->add_leaves(some, camera, mask);
    seconds += seconds_between(began, Clock::now());
    leaves += static_cast<double>(some.count);
  }
  void add_plant(const Plant& plant, const Camera& camera, Mask& mask, Mask* foliage) override {
    const auto began = Clock::now();
    renderer_->parts()->add_plant(plant, camera, mask, foliage);
    seconds += seconds_between(began, Clock::now());
    leaves += static_cast<double>(plant.leaves.size());
  }

  std::unique_ptr<SilhouetteRenderer> renderer_ = make_scanline_renderer();
};

/// One thread's evaluations.
class Evaluator {
 public:
  explicit Evaluator(const Setting& setting) : setting_(setting) {}

  void evaluate(Seed seed) {
    const auto began = Clock::now();
    renderer_.seconds = renderer_.leaves = 0;
    grow_and_draw(setting_.model, setting_.preset.values, seed, {}, renderer_, views_, plant_);
    const auto drawn = Clock::now();
    fitness_ += iou(mask_, setting_.target);
    const auto compared = Clock::now();
    grow_s += seconds_between(began, drawn) - renderer_.seconds;
    draw_s += renderer_.seconds;
    compare_s += seconds_between(drawn, compared);
    stems += static_cast<double>(plant_.stems.size());
    leaves += renderer_.leaves;
    ++count;
  }

  /// Evaluates for about `seconds`, at least once; the first is not counted.
  double run(double seconds, Seed first_seed) {
    evaluate(first_seed);
    grow_s = draw_s = compare_s = stems = leaves = 0;
    count = 0;
    const auto began = Clock::now();
    do evaluate(++first_seed);
    while (seconds_between(began, Clock::now()) < seconds);
    return static_cast<double>(count) / seconds_between(began, Clock::now());
  }

  std::size_t bytes() const {
    return memory_bytes(plant_) + mask_.words().size_bytes() + foliage_.words().size_bytes();
  }

  double grow_s = 0, draw_s = 0, compare_s = 0, stems = 0, leaves = 0;
  long count = 0;

 private:
  const Setting& setting_;
  TimedRenderer renderer_;
  Plant plant_;
  Mask mask_;
  Mask foliage_;  ///< of trees with leaves: fits of these ask for it
  std::array<SilhouetteView, 1> views_{
      {{&setting_.camera, &mask_, setting_.has_leaves ? &foliage_ : nullptr}}};
  double fitness_ = 0;  ///< keeps the comparison from being left out
};

void run_one_thread(const Setting& setting, double seconds, BenchResult& result) {
  Evaluator evaluator(setting);
  result.per_second = evaluator.run(seconds, 1);
  const double share = 1 / static_cast<double>(evaluator.count);
  result.grow_s = evaluator.grow_s * share;
  result.draw_s = evaluator.draw_s * share;
  result.compare_s = evaluator.compare_s * share;
  result.stems = evaluator.stems * share;
  result.leaf_count = evaluator.leaves * share;
  result.bytes_per_thread = evaluator.bytes();
}

double run_threads(const Setting& setting, double seconds, int threads) {
  double per_second = 0;
#pragma omp parallel num_threads(threads) reduction(+ : per_second)
  per_second += Evaluator(setting).run(seconds, static_cast<Seed>(omp_get_thread_num()) * 1'000'000);
  return per_second;
}

void count_differing(const Setting& setting, BenchResult& result) {
  Plant plant;
  Mask drawn, traced;
  setting.model.generate(setting.preset.values, 1, {}, plant);
  make_scanline_renderer()->draw(plant, setting.camera, drawn);
  make_embree_renderer()->draw(plant, setting.camera, traced);
  result.set_px = area_px(traced);
  result.differing_px = differing_px(drawn, traced);
}

}  // namespace

std::vector<std::string> bench_species() {
  return {"quaking_aspen", "lombardy_poplar", "small_pine", "palm", "weeping_willow"};
}

std::vector<BenchCase> bench_cases() {
  std::vector<BenchCase> cases;
  for (const std::string& species : bench_species())
    for (const int size_px : {128, 256, 512})
      for (const bool leaves : {true, false}) cases.push_back({species, size_px, leaves, {}});
  return cases;
}

BenchResult run_bench(const BenchCase& of, double seconds, int threads) {
  const Setting setting(of);
  BenchResult result{.of = of};
  run_one_thread(setting, seconds, result);
  result.per_second_all_threads = threads > 1 ? run_threads(setting, seconds, threads) : result.per_second;
  count_differing(setting, result);
  return result;
}

}  // namespace espalier
