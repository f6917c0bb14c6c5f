// Laws of what a run says of its plant: how much wood shows, how deep it is.
#include <gtest/gtest.h>

#include <espalier/fitting/run/plant_portrait.h>

#include "support/hand_made_plants.h"

namespace espalier {
namespace {

/// A cross of two beams on a trunk: twice as wide as deep, seen from the front.
Plant beams() {
  Plant plant;
  add_cylinder(plant, {0, 0, 0}, {0, 0, 4}, 0.2f);
  add_cylinder(plant, {-2, 0, 3}, {2, 0, 3}, 0.1f);
  add_cylinder(plant, {0, -1, 2}, {0, 1, 2}, 0.1f);
  return plant;
}

TEST(PlantPortrait, BareWoodShowsWhole) {
  const PlantPortrait portrait = portray(beams(), {}, {});
  EXPECT_EQ(portrait.visible_wood, 1);
  EXPECT_EQ(portrait.stems, 3u);
  EXPECT_EQ(portrait.leaves, 0u);
}

TEST(PlantPortrait, DepthOverWidthIsThatOfTheBoxAndTurnsWithTheView) {
  EXPECT_NEAR(portray(beams(), {0, 0}, {}).depth_over_width, 0.5, 0.02);
  EXPECT_NEAR(portray(beams(), {90, 0}, {}).depth_over_width, 2, 0.08);
}

/// What is behind a leaf is not seen, what is before it is.
TEST(PlantPortrait, LeavesHideTheWoodBehindThem) {
  Plant plant;
  add_cylinder(plant, {0, 0, 0}, {0, 0, 4}, 0.2f);
  const double bare = portray(plant, {}, {}).visible_wood;
  add_leaf(plant, {0, -1, 1}, {0, 0, 1}, {1, 0, 0}, 4, 4);
  const double before = portray(plant, {0, 0}, {}).visible_wood,
               behind = portray(plant, {180, 0}, {}).visible_wood;
  EXPECT_EQ(bare, 1);
  EXPECT_LT(before, behind);
  EXPECT_GT(behind, 0.05);
}

TEST(PlantPortrait, CountsTheNumbersOfBranches) {
  Overrides overrides;
  set_override(overrides.at({0, 1}).set, {Quantity::length, Relation::factor, 2, true});
  set_override(overrides.at({0, 1}).set, {Quantity::seed, Relation::value, 5, true});
  set_override(overrides.at({0, 2}).set, {Quantity::removed, Relation::value, 1, true});
  EXPECT_EQ(portray(beams(), {}, overrides).override_numbers, 3);
}

}  // namespace
}  // namespace espalier
