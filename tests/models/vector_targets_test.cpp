// All instruction sets of this machine give the same bits, the scalar one included: results do not depend
// on the processor.
#include <gtest/gtest.h>

#include <cmath>

#include <espalier/models/models.h>
#include <espalier/models/preset.h>
#include <espalier/render/scanlines/scanline_renderer.h>
#include <espalier/render/silhouette.h>

#include "support/only_target.h"

namespace espalier {
namespace {

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

/// A bundled preset in which about a third of the parameters have any value of their search bounds; curves in
/// one tree of two.
ParameterValues any_values(const ParameterTable& table, RandomKey key) {
  const std::vector<std::string> presets = bundled_presets();
  ParameterValues values = load_preset(presets[random_bits(key, 0) % presets.size()]).values;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const ParameterInfo& row = table.rows[i];
    if (uniform_unit(key, 1, static_cast<std::uint32_t>(i)) > 0.3f) continue;
    if (row.point >= 0 && random_bits(key, 3) % 2 == 0) continue;
    const double share = uniform_unit(key, 2, static_cast<std::uint32_t>(i));
    values[i] = row.search_lower + share * (row.search_upper - row.search_lower);
    if (row.scale == Scale::integer || row.scale == Scale::choice) values[i] = std::round(values[i]);
  }
  return values;
}

Result grown_in_budget(const Model& model, const ParameterValues& values, Seed seed) {
  Result result;
  model.generate(values, seed, {.budget = {1'000, 8'000}}, result.plant);
  make_scanline_renderer()->draw(result.plant, frame_bounds(bounds(result.plant), {}, 64, 64), result.mask);
  return result;
}

TEST(VectorTargets, GiveTheBitsOfTheScalarOneOnThousandsOfTrees) {
  const Model& model = model_by_name("weber_penn");
  const std::int64_t all = hwy::SupportedTargets();
  const std::int64_t best = all & -all;
  std::size_t stems = 0, leaves = 0;
  for (Seed seed = 0; seed < 2'000; ++seed) {
    const ParameterValues values = any_values(model.table(), root_key(seed));
    const auto grow = [&](std::int64_t target) {
      const OnlyTarget only(target);
      return grown_in_budget(model, values, seed);
    };
    const Result vector = grow(best), scalar = grow(HWY_SCALAR);
    ASSERT_EQ(vector.plant.leaves.position_m, scalar.plant.leaves.position_m) << seed;
    ASSERT_EQ(vector.plant.leaves.axis, scalar.plant.leaves.axis) << seed;
    ASSERT_EQ(vector.plant.leaves.length_m, scalar.plant.leaves.length_m) << seed;
    ASSERT_EQ(vector.plant.knots.point_m, scalar.plant.knots.point_m) << seed;
    ASSERT_EQ(vector.plant.knots.radius_m, scalar.plant.knots.radius_m) << seed;
    ASSERT_TRUE(vector.mask == scalar.mask) << seed;
    stems += vector.plant.stems.size();
    leaves += vector.plant.leaves.size();
  }
  EXPECT_GT(stems, 50'000u);
  EXPECT_GT(leaves, 300'000u);
}

}  // namespace
}  // namespace espalier
