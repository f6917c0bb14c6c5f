// Laws of flattening: within the tolerance, as coarse as that allows, ends and radii kept.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include <espalier/plant/flatten.h>

#include "support/mesh_fixtures.h"

namespace espalier {
namespace {

Polyline flatten(const Plant& plant, float tolerance_m) {
  Polyline line;
  flatten_stem(plant, 0, tolerance_m, line);
  return line;
}

float distance_to_segment(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 d = b - a;
  const float t = std::clamp(dot(p - a, d) / dot(d, d), 0.0f, 1.0f);
  return length(p - lerp(a, b, t));
}

/// The largest distance of points of the true spline to the polyline.
float largest_distance(const Plant& plant, const Polyline& line) {
  float largest = 0;
  const Knots& k = plant.knots;
  for (std::size_t s = 0; s + 1 < k.size(); ++s)
    for (float t = 0; t <= 1; t += 0.01f) {
      const float r = 1 - t;
      const Vec3 p = r * r * r * k.point_m[s] + 3 * r * r * t * k.handle_out_m[s] +
                     3 * r * t * t * k.handle_in_m[s + 1] + t * t * t * k.point_m[s + 1];
      float nearest = std::numeric_limits<float>::infinity();
      for (std::size_t i = 0; i + 1 < line.size(); ++i)
        nearest = std::min(nearest, distance_to_segment(p, line.point_m[i], line.point_m[i + 1]));
      largest = std::max(largest, nearest);
    }
  return largest;
}

Plant winding_plant() {
  Plant plant;
  add_winding_stem(plant, 6, 0.01f);
  return plant;
}

TEST(Flatten, StaysWithinTheTolerance) {
  const Plant plant = winding_plant();
  for (const float tolerance_m : {0.1f, 0.01f, 0.001f})
    EXPECT_LE(largest_distance(plant, flatten(plant, tolerance_m)), tolerance_m * 1.001f) << tolerance_m;
}

TEST(Flatten, IsNotFinerThanTheToleranceAsks) {
  // Wang's bound is within a small factor of the true distance on a smooth curve.
  const Plant plant = winding_plant();
  for (const float tolerance_m : {0.01f, 0.001f})
    EXPECT_GE(largest_distance(plant, flatten(plant, tolerance_m)), tolerance_m / 10) << tolerance_m;
}

TEST(Flatten, StraightStemsAreOneChord) {
  Plant plant;
  add_straight_stem(plant, {1, 2, 3}, {1, 2, 7}, 0.2f, 0.1f);
  const Polyline line = flatten(plant, 0.001f);
  ASSERT_EQ(line.size(), 2u);
  EXPECT_EQ(line.point_m[0], (Vec3{1, 2, 3}));
  EXPECT_EQ(line.point_m[1], (Vec3{1, 2, 7}));
  EXPECT_EQ(line.radius_m, (std::vector<float>{0.2f, 0.1f}));
}

TEST(Flatten, EveryKnotIsAPointWithItsRadius) {
  const Plant plant = winding_plant();
  const Polyline line = flatten(plant, 0.01f);
  for (std::size_t k = 0; k < plant.knots.size(); ++k) {
    const auto at = std::find(line.point_m.begin(), line.point_m.end(), plant.knots.point_m[k]);
    ASSERT_NE(at, line.point_m.end()) << k;
    EXPECT_EQ(line.radius_m[at - line.point_m.begin()], plant.knots.radius_m[k]);
  }
}

TEST(Flatten, RadiiBetweenKnotsLieBetweenTheirs) {
  const Polyline line = flatten(winding_plant(), 0.001f);
  EXPECT_TRUE(std::is_sorted(line.radius_m.rbegin(), line.radius_m.rend()));
}

TEST(Flatten, StemsWithoutLengthAreOnePoint) {
  Plant plant;
  add_straight_stem(plant, {1, 2, 3}, {1, 2, 3}, 0.2f, 0.1f);
  EXPECT_EQ(flatten(plant, 0.01f).size(), 1u);
}

TEST(Flatten, ReusedMemoryHoldsOnlyTheNewStem) {
  Plant plant = winding_plant();
  add_straight_stem(plant, {0, 0, 0}, {0, 0, 1}, 0.1f, 0.1f);
  Polyline line;
  flatten_stem(plant, 0, 0.001f, line);
  flatten_stem(plant, 1, 0.001f, line);
  EXPECT_EQ(line.size(), 2u);
}

}  // namespace
}  // namespace espalier
