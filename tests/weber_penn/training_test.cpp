// Growing inside of a volume: stems are shortened, bent along its border, or cut, but do not leave it.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <espalier/environment/volume.h>
#include <espalier/models/preset.h>
#include <espalier/weber_penn/model.h>
#include <espalier/weber_penn/table/parameters.h>

namespace espalier {
namespace {

Plant grow(const std::string& species, const Volume* volume, bool train, Seed seed) {
  ParameterValues values = load_preset(species).values;
  const ParameterTable& table = weber_penn_table();
  values[table.index_of("leaf_blos_num")] = 0;
  values[table.index_of("prune_ratio")] = 0;
  Plant plant;
  EXPECT_TRUE(weber_penn_model().generate(values, seed, {.prune_to = volume, .train = train}, plant).grown);
  return plant;
}

float length_of_level(const Plant& plant, int level) {
  float sum = 0;
  for (std::size_t stem = 0; stem < plant.stems.size(); ++stem)
    for (std::size_t k = plant.stems.first_knot[stem] + 1; k < plant.stems.first_knot[stem + 1]; ++k)
      if (plant.stems.level[stem] == level)
        sum += length(plant.knots.point_m[k] - plant.knots.point_m[k - 1]);
  return sum;
}

RC_GTEST_PROP(Training, NoBranchLeavesTheVolume, ()) {
  const auto species =
      *rc::gen::element<std::string>("quaking_aspen", "lombardy_poplar", "small_pine", "apple");
  const auto volume =
      make_cylinder({0, 0, 0}, 0.5f + 0.1f * static_cast<float>(*rc::gen::inRange(0, 20)), 60);
  const Plant plant = grow(species, volume.get(), true, static_cast<Seed>(*rc::gen::inRange(1, 50)));
  for (std::size_t stem = 0; stem < plant.stems.size(); ++stem) {
    if (plant.stems.level[stem] == 0) continue;  // bare trunks are exempt
    for (std::size_t k = plant.stems.first_knot[stem] + 1; k < plant.stems.first_knot[stem + 1]; ++k)
      RC_ASSERT(volume->contains(plant.knots.point_m[k]));
  }
}

TEST(Training, BendingKeepsMoreOfTheBranchesThanCutting) {
  const auto volume = make_cylinder({0, 0, 0}, 1, 60);
  for (const Seed seed : {1, 2, 3})
    EXPECT_GT(length_of_level(grow("quaking_aspen", volume.get(), true, seed), 1),
              1.1f * length_of_level(grow("quaking_aspen", volume.get(), false, seed), 1))
        << "seed " << seed;
}

TEST(Training, ATreeThatFitsIsLeftAsItIs) {
  const auto volume = make_box({0, 0, 0}, {500, 500, 500});
  const Plant trained = grow("quaking_aspen", volume.get(), true, 1),
              free = grow("quaking_aspen", nullptr, false, 1);
  ASSERT_EQ(trained.knots.size(), free.knots.size());
  for (std::size_t knot = 0; knot < free.knots.size(); ++knot) {  // trained by the plain formulas
    EXPECT_LT(length(trained.knots.point_m[knot] - free.knots.point_m[knot]), 1e-4f);
    EXPECT_NEAR(trained.knots.radius_m[knot], free.knots.radius_m[knot], 1e-6f);
  }
}

}  // namespace
}  // namespace espalier
