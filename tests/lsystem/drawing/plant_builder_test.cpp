// Laws of drawing: where the turtle goes, and what of it becomes stems and leaves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include <espalier/lsystem/drawing/plant_builder.h>
#include <espalier/lsystem/files/grammar_file.h>

#include "support/strings.h"

namespace espalier::lsystem {
namespace {

Plant plant_of(const std::string& text, int steps = 0) {
  const Grammar grammar = parse_grammar(text, "test.lsys");
  Derivation derivation(grammar);
  derivation.start(1);
  derivation.run(steps);
  Plant plant;
  build_plant(derivation.interpreted(), derivation.alphabet(), derivation.settings(), plant);
  return plant;
}

void expect_point(Vec3 got, Vec3 expected) {
  EXPECT_NEAR(got.x, expected.x, 1e-5f);
  EXPECT_NEAR(got.y, expected.y, 1e-5f);
  EXPECT_NEAR(got.z, expected.z, 1e-5f);
}

/// The end of the first stem.
Vec3 tip_of(const std::string& axiom) {
  const Plant plant = plant_of("angle: 90\naxiom: " + axiom + "\n");
  return plant.knots.point_m[plant.stems.first_knot[1] - 1];
}

TEST(PlantBuilder, TurnsAreThoseOfTheFigure) {  // [Topiary, Fig. 1]; front view: x right, z up, y away
  expect_point(tip_of("F"), {0, 0, 1});
  expect_point(tip_of("+F"), {-1, 0, 0});
  expect_point(tip_of("-F"), {1, 0, 0});
  expect_point(tip_of("&F"), {0, 1, 0});
  expect_point(tip_of("^F"), {0, -1, 0});
  expect_point(tip_of("\\+F"), {0, -1, 0});
  expect_point(tip_of("/+F"), {0, 1, 0});
  expect_point(tip_of("F|F"), {0, 0, 0});
  expect_point(tip_of("F[+F]F(2)"), {0, 0, 3});
  expect_point(tip_of("F(3)@(2,0,3)F"), {1, 0, 3});
  expect_point(tip_of("&(90)/(30)$+F"), {-1, 0, 0});
}

TEST(PlantBuilder, SegmentsOfAnAxisAreOneStem) {
  const Plant plant = plant_of("axiom: F+(20)F[-F][+FF]F\n");
  ASSERT_EQ(plant.stems.size(), 3u);
  EXPECT_EQ(plant.stems.first_knot, (std::vector<std::uint32_t>{0, 4, 6, 9}));
  EXPECT_EQ(plant.stems.parent, (std::vector<std::int32_t>{-1, 0, 0}));
  EXPECT_EQ(plant.stems.level, (std::vector<std::uint8_t>{0, 1, 1}));
}

TEST(PlantBuilder, JointsAreSmooth) {
  const Plant plant = plant_of("axiom: F+(40)F\n");
  const Vec3 in = normalized(plant.knots.point_m[1] - plant.knots.handle_in_m[1]);
  const Vec3 out = normalized(plant.knots.handle_out_m[1] - plant.knots.point_m[1]);
  EXPECT_NEAR(dot(in, out), 1, 1e-5f);
  EXPECT_NEAR(std::acos(in.z) * 180 / M_PI, 20, 1e-2);
}

TEST(PlantBuilder, BranchesWithoutSegmentsVanish) {
  EXPECT_EQ(plant_of("axiom: F[+A][-(3)[B]]F\n").stems.size(), 1u);
  EXPECT_EQ(plant_of("axiom: [[]A]\n").stems.size(), 0u);
}

TEST(PlantBuilder, JumpsStartAnotherStem) { EXPECT_EQ(plant_of("axiom: FfF\n").stems.size(), 2u); }

TEST(PlantBuilder, WidthsAreDiametersInUnits) {
  const Plant plant = plant_of("unit: 0.5\nwidth: 0.4\naxiom: F!(0.2)FF(1,0.2)\n");
  EXPECT_FLOAT_EQ(plant.knots.radius_m[0], 0.1f);
  EXPECT_FLOAT_EQ(plant.knots.radius_m[1], 0.075f);  // the mean, where the width changes
  EXPECT_FLOAT_EQ(plant.knots.radius_m[3], 0.05f);
  EXPECT_FLOAT_EQ(plant.knots.point_m[3].z, 1.5f);
}

TEST(PlantBuilder, PolygonsHaveTheirArea) {
  // A square of side 2, its corner cut out: an L of area 3, in triangles.
  const Plant plant = plant_of("angle: 90\naxiom: {.F(2)-F-F+F-F-F(2)}\n");
  ASSERT_GT(plant.leaves.size(), 0u);
  double area = 0;
  for (std::size_t i = 0; i < plant.leaves.size(); ++i)
    area += 0.5 * length(cross(plant.leaves.side[i] * plant.leaves.width_m[i],
                               plant.leaves.axis[i] * plant.leaves.length_m[i]));
  EXPECT_NEAR(area, 3, 1e-4);
  EXPECT_EQ(plant.leaf_shape, 10);
  EXPECT_EQ(plant.stems.size(), 0u);
}

TEST(PlantBuilder, SegmentsCarryLeaves) {
  const Plant plant = plant_of("segments: leafy\naxiom: F(2,0.1,4,30,90)\n");
  ASSERT_EQ(plant.leaves.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(plant.leaves.position_m[i].z, 0.5 * static_cast<double>(i + 1), 1e-5);
    EXPECT_NEAR(std::acos(plant.leaves.axis[i].z) * 180 / M_PI, 30, 1e-2);
  }
  EXPECT_NEAR(dot(plant.leaves.side[0], plant.leaves.side[1]), 0, 1e-5);
}

// cpfg and L-Py have models with ages there: leaves grow only where the file says so.
TEST(PlantBuilder, SegmentsArePlainUnlessTheFileSaysOtherwise) {
  for (const char* head : {"", "segments: plain\n"}) {
    const Plant plant = plant_of(fmt::format("{}axiom: F(1,0.1,3)G(1,0.2,3)\n", head));
    EXPECT_EQ(plant.leaves.size(), 0u);
    EXPECT_EQ(plant.knots.size(), 3u);
    EXPECT_FLOAT_EQ(plant.knots.radius_m.back(), 0.1f);
  }
  EXPECT_EQ(plant_of("segments: leafy\naxiom: F(1,0.1,3)G(1,0.2,3)\n").leaves.size(), 6u);
}

TEST(PlantBuilder, MoreParametersOfASymbolChangeNothing) {
  const Plant plant =
                  plant_of("axiom: F+(30,7)F(2,0.1,9,9,9,9)!(0.2,5)/(90,1)-(20,1,2)F|(3)f(1,8)F@o(0.3,4)\n"),
              plain = plant_of("axiom: F+(30)F(2,0.1)!(0.2)/(90)-(20)F|f(1)F@o(0.3)\n");
  EXPECT_EQ(plant.knots.point_m, plain.knots.point_m);
  EXPECT_EQ(plant.knots.radius_m, plain.knots.radius_m);
}

TEST(PlantBuilder, TrianglesOfOneLeafHaveOneShade) {
  // A polygon of several triangles, two more that are one leaf with it, and two surfaces.
  const Plant plant =
      plant_of("angle: 22.5\naxiom: {-F+F+F-|-F+F+F}[{.F+(90)F}]{.F-(90)F}~(\"maple\")F~(\"leaf\")\n");
  ASSERT_EQ(plant.leaves.shade.size(), plant.leaves.size());
  const std::size_t polygons =
      static_cast<std::size_t>(std::count(plant.leaves.shade.begin(), plant.leaves.shade.end(), kPlainShade));
  EXPECT_EQ(polygons, 4u + 1 + 1);
  std::set<std::uint32_t> others(plant.leaves.shade.begin(), plant.leaves.shade.end());
  others.erase(kPlainShade);
  EXPECT_EQ(others.size(), 2u);
  EXPECT_GT(plant.leaves.size(), polygons + 2);
  EXPECT_TRUE(plant_of("axiom: F~(\"leaf\")F~(\"leaf\")\n").leaves.shade.empty());
}

TEST(PlantBuilder, SurfacesStandWhereTheTurtleIs) {
  const Plant plant = plant_of("leaf_length: 2\nangle: 90\naxiom: F+~(\"leaf\",3)~(\"blossom\")\n");
  ASSERT_EQ(plant.leaves.size(), 2u);
  expect_point(plant.leaves.axis[0], {-1, 0, 0});
  EXPECT_FLOAT_EQ(plant.leaves.length_m[0], 6);
  EXPECT_EQ(plant.leaves.kind[1], LeafKind::blossom);
  EXPECT_NEAR(dot(plant.leaves.axis[0], plant.leaves.side[0]), 0, 1e-6);
}

JointedPlant jointed_plant_of(const std::string& text) {
  const Grammar grammar = parse_grammar(text, "test.lsys");
  Derivation derivation(grammar);
  derivation.start(1);
  JointedPlant grown;
  build_plant(derivation.interpreted(), derivation.alphabet(), derivation.settings(), grown.plant,
              &grown.joints);
  return grown;
}

/// The stem and the knot of it that bear each leaf.
std::vector<std::pair<std::int32_t, std::uint32_t>> bearers_of_leaves(const JointedPlant& grown) {
  std::vector<std::pair<std::int32_t, std::uint32_t>> bearers;
  for (const std::uint32_t organ : grown.joints.organ_of_leaf)
    bearers.emplace_back(grown.joints.organs[organ].stem, grown.joints.organs[organ].place.knot);
  return bearers;
}

using Bearers = std::vector<std::pair<std::int32_t, std::uint32_t>>;

TEST(PlantBuilder, LeavesHangWhereTheTurtleWas) {
  const JointedPlant grown =
      jointed_plant_of("axiom: ~(\"leaf\")F[+F~(\"leaf\")]F[~(\"leaf\")]Ff~(\"leaf\")[f~(\"blossom\")]\n");
  EXPECT_EQ(bearers_of_leaves(grown), (Bearers{{-1, 0}, {1, 1}, {0, 2}, {0, 3}, {0, 3}}));
  EXPECT_EQ(grown.joints.stem_place[1].knot, 1u);
}

TEST(PlantBuilder, TrianglesOfASurfaceAreOneOrgan) {
  const JointedPlant grown = jointed_plant_of("axiom: F[+F~(\"leaf\")]{+f-f-f-f}~(\"blossom\")\n");
  ASSERT_EQ(grown.joints.organ_of_leaf.size(), grown.plant.leaves.size());
  EXPECT_EQ(grown.joints.organs.size(), 3u);
  for (std::size_t i = 0; i < grown.plant.leaves.size(); ++i) {
    const std::uint32_t organ = grown.joints.organ_of_leaf[i];
    EXPECT_EQ(grown.joints.organs[organ].stem, organ == 0 ? 1 : 0);
    EXPECT_EQ(grown.plant.leaves.kind[i] == LeafKind::blossom, organ == 2);
  }
}

TEST(PlantBuilder, LeavesAlongASegmentHangBetweenItsKnots) {
  const JointedPlant grown = jointed_plant_of("segments: leafy\naxiom: FF(1,0.1,4)\n");
  ASSERT_EQ(grown.joints.organs.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(grown.joints.organs[i].place.knot, 1u);
    EXPECT_FLOAT_EQ(grown.joints.organs[i].place.t, 0.25f * static_cast<float>(i + 1));
  }
}

TEST(PlantBuilder, TropismTurnsByTheAngleOfItsFormula) {  // [Herbaceous §3]: e·|H × T|
  const Plant plant = plant_of("tropism: 0, 0, -1\nsusceptibility: 0.3\naxiom: +(90)FF\n");
  const Vec3 second = normalized(plant.knots.point_m[2] - plant.knots.point_m[1]);
  EXPECT_NEAR(std::asin(-second.z), 0.3, 1e-4);
}

}  // namespace
}  // namespace espalier::lsystem
