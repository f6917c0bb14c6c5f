// Trees grown for their times are those of the models.
#include <gtest/gtest.h>

#include <cmath>

#include <espalier/experiments/growth/growth_phases.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>

namespace espalier {
namespace {

TEST(GrowthPhases, AnLSystemsPlantIsThatOfItsModel) {
  const auto grower = time_lsystem("small_pine");
  const Model& model = model_by_name("small_pine.lsys");
  for (const Seed seed : {1, 5}) {
    const GrowthTimes times = grower->grow(seed);
    Plant plant;
    model.generate(model.table().defaults(), seed, {}, plant);
    EXPECT_EQ(grower->plant().knots.point_m, plant.knots.point_m);
    EXPECT_EQ(grower->plant().leaves.position_m, plant.leaves.position_m);
    EXPECT_EQ(times.all_s, times.derivation_s + times.interpretation_s);
  }
}

TEST(GrowthPhases, APresetsPlantIsThatOfItsModel) {
  const auto grower = time_preset("palm");
  const GrowthTimes times = grower->grow(3);
  const Preset preset = load_preset("palm");
  Plant plant;
  model_by_name(preset.model).generate(preset.values, 3, {}, plant);
  EXPECT_EQ(grower->plant().knots.point_m, plant.knots.point_m);
  EXPECT_EQ(grower->plant().leaves.position_m, plant.leaves.position_m) << "the last growth is the leafy one";
  EXPECT_TRUE(std::isnan(times.derivation_s));
  EXPECT_GE(times.leaves_s, 0);
}

}  // namespace
}  // namespace espalier
