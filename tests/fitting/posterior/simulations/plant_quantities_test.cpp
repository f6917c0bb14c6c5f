// What foresters measure, of plants whose volumes and areas are known.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include <espalier/fitting/posterior/simulations/plant_quantities.h>
#include <espalier/plant/leaf_outlines.h>

#include "support/hand_made_plants.h"

namespace espalier {
namespace {

constexpr double kPi = std::numbers::pi;

/// A straight trunk along z that narrows from 0.3 to 0.1 m over 10 m.
Plant trunk() {
  Plant plant;
  const Vec3 points[] = {{0, 0, 0}, {0, 0, 10}};
  const float radii[] = {0.3f, 0.1f};
  add_stem(plant, points, radii);
  return plant;
}

/// Leaves all over a cylinder of radius 2 m between 4 and 10 m, which need not stand on the trunk.
Plant tree(Vec3 middle = {0, 0, 0}) {
  Plant plant = trunk();
  for (int level = 0; level < 60; ++level)
    for (int ring = 0; ring < 5; ++ring)
      for (int turn = 0; turn < 64; ++turn) {
        const double angle = 2 * kPi * (turn + 0.5) / 64, radius = 0.5 * ring;
        const Vec3 on_ring{static_cast<float>(radius * std::cos(angle)),
                           static_cast<float>(radius * std::sin(angle)),
                           4 + 0.1f * (static_cast<float>(level) + 0.5f)};
        add_leaf(plant, middle + on_ring, {0, 0, 1}, {1, 0, 0}, 0.1f, 0.05f);
      }
  return plant;
}

std::map<std::string, double> measure(const Plant& plant, double height_m = 10, double lowest_m = 0,
                                      double tall_m = 10) {
  std::map<std::string, double> named;
  const std::vector<double> quantities = quantities_of(plant, lowest_m, tall_m, height_m);
  for (std::size_t i = 0; i < quantities.size(); ++i) named[kPlantQuantities[i].name] = quantities[i];
  return named;
}

TEST(PlantQuantities, AreThoseOfAConeAndACylinder) {
  const auto measured = measure(tree());
  EXPECT_NEAR(measured.at("wood_volume"), kPi / 3 * 10 * (0.09 + 0.03 + 0.01), 1e-5);
  EXPECT_NEAR(measured.at("crown_volume"), kPi * 4 * 6,
              0.06 * kPi * 4 * 6);  // layers of a sixteenth of the height
  EXPECT_NEAR(measured.at("crown_base"), 4.15, 0.11);
  EXPECT_EQ(measured.at("leaves"), 60 * 5 * 64);
  EXPECT_EQ(measured.at("stems"), 1);
  EXPECT_NEAR(measured.at("trunk_radius"), 0.3 - 0.2 * 0.13, 1e-6);
  const Plant plant = tree();
  EXPECT_NEAR(measured.at("leaf_area"),
              leaf_area_m2(plant.leaves.length_m, plant.leaves.width_m, plant.leaf_shape), 1e-6);
}

TEST(PlantQuantities, GrowWithThePowersOfTheirUnits) {
  const auto small = measure(tree(), 10), large = measure(tree(), 30);
  for (const PlantQuantity& quantity : kPlantQuantities) {
    if (std::string(quantity.name) == "trunk_radius") continue;  // at 1.3 m in both
    EXPECT_NEAR(large.at(quantity.name), small.at(quantity.name) * std::pow(3, quantity.metres),
                1e-6 * large.at(quantity.name))
        << quantity.name;
  }
  EXPECT_NEAR(large.at("trunk_radius"), 3 * (0.3 - 0.2 * 0.13 / 3), 1e-6);
}

TEST(PlantQuantities, AreMeasuredFromTheLowestPoint) {
  Plant raised = tree();
  for (Vec3& point : raised.knots.point_m) point.z += 2;
  for (Vec3& point : raised.leaves.position_m) point.z += 2;
  const auto measured = measure(tree()), above = measure(raised, 10, 2);
  for (const auto& [name, value] : measured) EXPECT_NEAR(above.at(name), value, 1e-4 * value) << name;
}

TEST(PlantQuantities, OfTheCrownDoNotDependOnWhereItStands) {
  EXPECT_NEAR(measure(tree({3, -1, 0})).at("crown_volume"), measure(tree()).at("crown_volume"),
              0.05 * measure(tree()).at("crown_volume"));
}

TEST(PlantQuantities, OfABareTrunkAreFinite) {
  for (const auto& [name, value] : measure(trunk())) EXPECT_TRUE(std::isfinite(value)) << name;
  EXPECT_EQ(measure(trunk()).at("leaf_area"), 0);
  EXPECT_NEAR(measure(trunk(), 2).at("trunk_radius"), 0.2 * (0.3 - 0.2 * 0.5), 1e-6);  // at half of 2 m
}

}  // namespace
}  // namespace espalier
