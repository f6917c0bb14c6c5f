// Laws of the bounding box of a plant: flat ends of stems, bulges of curves, leaf polygons.
#include <gtest/gtest.h>

#include <cmath>

#include <espalier/plant/plant.h>

namespace espalier {
namespace {

void add_stem(Plant& plant, Vec3 p0, Vec3 p1, Vec3 p2, Vec3 p3, float radius_m) {
  if (plant.stems.first_knot.empty()) plant.stems.first_knot.push_back(0);
  plant.knots.point_m.insert(plant.knots.point_m.end(), {p0, p3});
  plant.knots.handle_in_m.insert(plant.knots.handle_in_m.end(), {p0, p2});
  plant.knots.handle_out_m.insert(plant.knots.handle_out_m.end(), {p1, p3});
  plant.knots.radius_m.insert(plant.knots.radius_m.end(), {radius_m, radius_m});
  plant.stems.first_knot.push_back(static_cast<std::uint32_t>(plant.knots.size()));
  plant.stems.parent.push_back(-1);
  plant.stems.level.push_back(0);
  plant.stems.path_key.push_back(1);
  plant.stems.origin.push_back(-1);
  plant.stems.child_index.push_back(0);
}

TEST(PlantBounds, AnEmptyPlantHasAZeroBoxAtTheOrigin) {
  const Bounds box = bounds(Plant{});
  EXPECT_EQ(box.lower, (Vec3{0, 0, 0}));
  EXPECT_EQ(box.upper, (Vec3{0, 0, 0}));
}

TEST(PlantBounds, AnUprightTrunkStandsOnTheGround) {
  Plant plant;
  add_stem(plant, {0, 0, 0}, {0, 0, 1}, {0, 0, 2}, {0, 0, 3}, 0.5f);
  const Bounds box = bounds(plant);
  EXPECT_EQ(box.lower, (Vec3{-0.5f, -0.5f, 0}));
  EXPECT_EQ(box.upper, (Vec3{0.5f, 0.5f, 3}));
}

TEST(PlantBounds, ACurveIsBoundedWhereItBulges) {
  Plant plant;
  add_stem(plant, {0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 0, 3}, 0.1f);
  EXPECT_NEAR(bounds(plant).upper.x, 3.1f, 1e-4f);  // the curve's middle is at 3/4 of its handles
}

TEST(PlantBounds, ALeafReachesItsTip) {
  Plant plant;
  plant.leaf_shape = 9;
  plant.leaves = {{{1, 2, 3}}, {{0, 0, 1}}, {{1, 0, 0}}, {2.0f}, {4.0f}, {LeafKind::leaf}};
  const Bounds box = bounds(plant);
  EXPECT_EQ(box.lower, (Vec3{-1, 2, 3}));
  EXPECT_EQ(box.upper, (Vec3{3, 2, 5}));
}

/// What lies within the box of others is passed over; what juts out of it by a little is not.
TEST(PlantBounds, IsThatOfAllPartsWhateverTheirOrder) {
  Plant inner_last, inner_first;
  const auto add_outer = [](Plant& plant) {
    add_stem(plant, {-1, -1, 0}, {-1, -1, 1}, {1, 1, 2}, {1, 1, 3}, 0.5f);
  };
  const auto add_inner = [](Plant& plant) {
    add_stem(plant, {0, 0, 0}, {2.2f, 0, 1}, {2.2f, 0, 2}, {0, 0, 3}, 0.1f);
  };
  add_outer(inner_last), add_inner(inner_last), add_inner(inner_first), add_outer(inner_first);
  inner_last.leaves = {{{0, 0, 1}, {0, 1.4f, 1}},
                       {{0, 0, 1}, {0, 1, 0}},
                       {{1, 0, 0}, {1, 0, 0}},
                       {0.5f, 0.5f},
                       {0.1f, 0.1f},
                       {LeafKind::leaf, LeafKind::blossom}};
  inner_first.leaves = {{{0, 1.4f, 1}, {0, 0, 1}},
                        {{0, 1, 0}, {0, 0, 1}},
                        {{1, 0, 0}, {1, 0, 0}},
                        {0.5f, 0.5f},
                        {0.1f, 0.1f},
                        {LeafKind::blossom, LeafKind::leaf}};
  EXPECT_EQ(bounds(inner_last).lower, bounds(inner_first).lower);
  EXPECT_EQ(bounds(inner_last).upper, bounds(inner_first).upper);
  EXPECT_NEAR(bounds(inner_last).upper.x, 0.75f * 2.2f + 0.1f, 1e-4f);
  EXPECT_GT(bounds(inner_last).upper.y, 1.55f);
}

TEST(PlantBounds, ClearEmptiesEveryArrayAndKeepsMemory) {
  Plant plant;
  add_stem(plant, {0, 0, 0}, {0, 0, 1}, {0, 0, 2}, {0, 0, 3}, 0.5f);
  plant.leaves = {{{1, 2, 3}}, {{0, 0, 1}}, {{1, 0, 0}}, {2.0f}, {4.0f}, {LeafKind::leaf}};
  plant.clear();
  EXPECT_EQ(plant.stems.size() + plant.knots.size() + plant.leaves.size(), 0u);
  EXPECT_TRUE(plant.stems.first_knot.empty() && plant.knots.point_m.empty() && plant.leaves.kind.empty());
  EXPECT_GE(plant.knots.point_m.capacity(), 2u);
}

}  // namespace
}  // namespace espalier
