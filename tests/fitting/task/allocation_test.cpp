// An evaluation allocates nothing once its memory has grown to size: grow, draw, compare.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <new>

#include <espalier/image/measures/objective.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>
#include <espalier/render/grow_and_draw.h>
#include <espalier/render/scanlines/scanline_renderer.h>

namespace {
std::atomic<long> allocations = 0;
}

// Counts what this program allocates with new; malloc and free do the work.
void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  ++allocations;
  const auto step = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(step, (size + step - 1) / step * step)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace espalier {
namespace {

TEST(Allocation, NoneOnceWarm) {
  for (const char* species : {"quaking_aspen", "small_pine", "palm", "weeping_willow"}) {
    const Preset preset = load_preset(species);
    const Model& model = model_by_name(preset.model);
    Plant plant;
    model.generate(preset.values, 1000, {}, plant);
    const Camera camera = frame_bounds(bounds(plant), {}, 128, 128);
    const auto renderer = make_scanline_renderer();
    Mask mask;
    renderer->draw(plant, camera, mask);
    const PreparedTarget target(mask);
    const MaskObjective objective = parse_objective("0.5*truncated_distance+0.5*iou");
    Mask leaves;
    const std::array views{SilhouetteView{&camera, &mask, &leaves}};
    const auto evaluate = [&](Seed seed) {
      model.generate(preset.values, seed, {}, plant);
      renderer->draw(plant, camera, mask);
      grow_and_draw(model, preset.values, seed, {}, *renderer, views, plant);
      return dissimilarity(objective, mask, target);
    };
    for (Seed seed = 1; seed <= 3; ++seed) evaluate(seed);
    const long before = allocations;
    double sum = 0;
    for (Seed seed = 1; seed <= 3; ++seed) sum += evaluate(seed);
    EXPECT_EQ(allocations - before, 0) << species;
    EXPECT_GT(sum, 0);
  }
}

TEST(Allocation, IsCounted) {
  const long before = allocations;
  const std::vector<int> numbers(1000, 7);
  EXPECT_GT(allocations - before, 0) << numbers[3];
}

}  // namespace
}  // namespace espalier
