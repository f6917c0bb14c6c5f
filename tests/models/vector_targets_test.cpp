// All instruction sets of this machine give the same bits, the scalar one included: results do not depend
// on the processor.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "models/models.h"
#include "models/preset.h"
#include "render/silhouette.h"

namespace espalier {
namespace {

/// Uses one instruction set until it goes out of scope.
class OnlyTarget {
 public:
  explicit OnlyTarget(std::int64_t target) { use(target); }
  ~OnlyTarget() { use(0); }

 private:
  static void use(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
};

struct Result {
  Plant plant;
  Mask mask;
};

Result grown_and_drawn(const std::string& species) {
  const Preset preset = load_preset(species);
  Result result;
  model_by_name(preset.model).generate(preset.values, 3, {}, result.plant);
  const Camera camera = frame_bounds(bounds(result.plant), {}, 200, 130);
  make_scanline_renderer()->draw(result.plant, camera, result.mask);
  return result;
}

TEST(VectorTargets, AllGiveTheSameBits) {
  const std::int64_t all = hwy::SupportedTargets();
  ASSERT_NE(all & (all - 1), 0) << "this machine has one instruction set only";
  for (const char* species : {"quaking_aspen", "small_pine", "fan_palm"}) {
    const Result best = grown_and_drawn(species);
    for (std::int64_t left = all; left != 0; left &= left - 1) {
      const std::int64_t target = left & -left;
      const OnlyTarget only(target);
      const Result result = grown_and_drawn(species);
      EXPECT_EQ(result.plant.leaves.position_m, best.plant.leaves.position_m) << hwy::TargetName(target);
      EXPECT_EQ(result.plant.leaves.axis, best.plant.leaves.axis) << hwy::TargetName(target);
      EXPECT_EQ(result.plant.knots.point_m, best.plant.knots.point_m) << hwy::TargetName(target);
      EXPECT_TRUE(result.mask == best.mask) << hwy::TargetName(target);
    }
  }
}

}  // namespace
}  // namespace espalier
