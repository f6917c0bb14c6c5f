// Seasons of shaded pictures.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <espalier/core/error.h>
#include <espalier/render/shading/seasons.h>

#include "support/hand_made_plants.h"

namespace espalier {
namespace {

/// The middle of a picture of one large leaf.
Rgb leaf_in(const std::string& season) {
  Plant plant;
  plant.leaf_shape = 9;
  add_leaf(plant, {0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 2, 2);
  const Camera camera = frame_bounds(bounds(plant), {}, 32, 32);
  ShadedSettings settings;
  apply_season(season, plant, settings);
  return render_shaded(plant, camera, settings).at(16, 16);
}

TEST(Seasons, ChangeTheColourOfLeaves) {
  const Rgb summer = leaf_in("summer"), autumn = leaf_in("autumn"), spring = leaf_in("spring");
  EXPECT_GT(summer.g, summer.r);
  EXPECT_GT(autumn.r, autumn.g) << "leaves turn";
  EXPECT_GT(spring.g, summer.g) << "young leaves are bright";
}

TEST(Colors, OfASpeciesAreThoseOfItsBarkAndLeaves) {
  const PlantColors larch{{200, 200, 190, true}, {60, 120, 40, true}, {224, 176, 48, true}};
  ShadedSettings summer, autumn, plain;
  apply_colors(larch, "summer", summer);
  apply_colors(larch, "autumn", autumn);
  apply_colors({}, "autumn", plain);
  EXPECT_GT(summer.bark.x, ShadedSettings{}.bark.x);
  EXPECT_GT(summer.leaf.y, summer.leaf.x);
  EXPECT_GT(autumn.leaf.x, autumn.leaf.y);
  EXPECT_EQ(plain.leaf, ShadedSettings{}.leaf);
  EXPECT_EQ(plain.bark, ShadedSettings{}.bark);
}

TEST(Seasons, SummerIsAsTheModelGrows) {
  Plant plant = random_tree(10, 40, 1);
  const std::size_t leaves = plant.leaves.size();
  ShadedSettings settings;
  apply_season("summer", plant, settings);
  EXPECT_EQ(plant.leaves.size(), leaves);
  EXPECT_EQ(settings.leaf, ShadedSettings{}.leaf);
}

TEST(Seasons, InWinterOnlyWoodIsLeft) {
  Plant plant = random_tree(10, 40, 1);
  const std::size_t stems = plant.stems.size();
  ShadedSettings settings;
  apply_season("winter", plant, settings);
  EXPECT_EQ(plant.leaves.size(), 0u);
  EXPECT_EQ(plant.stems.size(), stems);
}

TEST(Seasons, ThereAreNoOthers) {
  for (const std::string& name : season_names()) EXPECT_NO_THROW(check_season(name));
  try {
    check_season("monsoon");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                testing::HasSubstr("got 'monsoon', expected one of: summer, autumn, winter, spring"));
  }
}

}  // namespace
}  // namespace espalier
