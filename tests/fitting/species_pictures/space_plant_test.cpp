// Every point of the plane gives a tree that grows within the budget, thousands of them.
#include <gtest/gtest.h>

#include <espalier/core/random.h>
#include <espalier/fitting/species_pictures/space_plant.h>
#include <espalier/fitting/species_space/preset_collection.h>

namespace espalier {
namespace {

/// Points on the species' range three times as wide, and some very far out.
Eigen::Vector2d random_point(std::uint32_t index) {
  const RandomKey key = root_key(7);
  const double reach = index % 10 == 0 ? 1e6 : 27;
  return {reach * uniform_signed(key, 0, index), reach * uniform_signed(key, 1, index)};
}

TEST(SpacePlant, EveryPointOfThePlaneGrowsWithinTheBudget) {
  constexpr std::uint32_t kPoints = 1000;
  const GrowthBudget budget{1'500, 6'000};  // less than a fit's
  for (const char* encoding : {"monotone", "raw"}) {
    const SpeciesSpace space = make_species_space(load_presets({}), encoding, 2);
    Plant plant;
    int grown = 0, moved = 0;
    for (std::uint32_t i = 0; i < kPoints; ++i) {
      const GrowingPlant point = growing_plant_at(space, random_point(i), budget, 1);
      for (std::size_t row = 0; row < point.values.size(); ++row)
        check_value(space.model->table().rows[row], point.values[row], encoding);
      grown += space.model->generate(point.values, 1, {budget, nullptr}, plant).grown;
      moved += point.moved_by > 0;
    }
    EXPECT_EQ(grown, kPoints) << encoding;
    EXPECT_LT(moved, 0.05 * kPoints) << encoding << ": nearly all grow where they are";
  }
}

TEST(SpacePlant, APointThatFitsTheBudgetIsLeftAsItIs) {
  const SpeciesSpace space = make_species_space(load_presets({}), "monotone", 2);
  const GrowingPlant plant = growing_plant_at(space, Eigen::Vector2d(0.8, -1.2), {}, 1);
  EXPECT_FALSE(plant.thinned);
  EXPECT_EQ(plant.moved_by, 0);
  EXPECT_EQ(plant.values, plant_at(space, Eigen::Vector2d(0.8, -1.2)).values);
  EXPECT_EQ(plant.wanted, plant.values);
}

TEST(SpacePlant, SaysHowLargeAThinnedPlantWouldHaveBeen) {
  const SpeciesSpace space = make_species_space(load_presets({}), "monotone", 2);
  const Eigen::Vector2d point(0.8, -1.2);
  const GrowingPlant plant = growing_plant_at(space, point, {500, 2'000}, 1);
  ASSERT_TRUE(plant.thinned);
  EXPECT_EQ(plant.wanted, plant_at(space, point).values);
  const GrowthEstimate wanted = wanted_size(space, plant, 1);
  Plant grown;
  ASSERT_TRUE(space.model->generate(plant_at(space, point).values, 1, {}, grown).grown);
  EXPECT_EQ(wanted.stems, static_cast<double>(grown.stems.size()));
  EXPECT_EQ(wanted.leaves, static_cast<double>(grown.leaves.size()));
  EXPECT_GT(wanted.leaves, 2'000);
}

}  // namespace
}  // namespace espalier
