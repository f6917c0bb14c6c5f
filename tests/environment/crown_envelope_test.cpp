// Laws of the asymmetric crown envelope: its parametric form and its implicit one, reach, distances, text.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include <espalier/core/error.h>
#include <espalier/environment/crown_envelope.h>

namespace espalier {
namespace {

using testing::HasSubstr;

struct Point {
  double x, y, z;
};

/// Boudon et al. 2003, Fig. 5: no two numbers alike.
CrownShape lopsided() {
  return {.top_m = {0.1f, 0, 1},
          .bottom_m = {0, 0, 0},
          .radius_m = {0.5f, 0.4f, 0.3f, 0.45f},
          .rim_m = {0.35f, 0.4f, 0.5f, 0.3f},
          .shape_above = 2,
          .shape_below = 1.3f};
}

CrownShape unit_ball() {
  return {.top_m = {0, 0, 1}, .bottom_m = {0, 0, -1}, .radius_m = {1, 1, 1, 1}, .rim_m = {0, 0, 0, 0}};
}

/// Any crown, with leaning tops and bottoms.
CrownShape any_crown() {
  const auto number = [](double low, double high) {
    return static_cast<float>(low + (high - low) * *rc::gen::inRange(0, 10001) / 10000.0);
  };
  CrownShape crown;
  crown.top_m.z = number(4, 12);
  crown.bottom_m.z = number(0, 3);
  for (float& radius : crown.radius_m) radius = number(0.5, 5);
  for (float& rim : crown.rim_m) rim = std::lerp(crown.bottom_m.z, crown.top_m.z, number(0.05, 0.95));
  const auto lean = [&](Vec3& apex) {
    const float x = number(-0.6, 0.6), y = number(-0.6, 0.6);
    apex.x = x * crown.radius_m[x > 0 ? 0 : 2];
    apex.y = y * crown.radius_m[y > 0 ? 1 : 3];
  };
  lean(crown.top_m);
  lean(crown.bottom_m);
  crown.shape_above = number(1, 6);
  crown.shape_below = number(1, 6);
  crown.profile = *rc::gen::element(CrownProfile::superellipse, CrownProfile::power);
  return crown;
}

Vec3 any_direction() {
  const auto number = [] { return static_cast<float>(*rc::gen::inRange(-1000, 1001)) / 1000; };
  return normalized({number(), number(), number()});
}

/// 400 on a spiral around the sphere.
const std::vector<Vec3>& many_directions() {
  static const std::vector<Vec3> directions = [] {
    std::vector<Vec3> all;
    for (int i = 0; i < 400; ++i) {
      const float z = (2 * static_cast<float>(i) + 1) / 400 - 1, r = std::sqrt(1 - z * z);
      const float angle = 2.399963f * static_cast<float>(i);
      all.push_back({r * std::cos(angle), r * std::sin(angle), z});
    }
    return all;
  }();
  return directions;
}

/// The rim as PlantGL draws it.
Point rim_point(const CrownShape& crown, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const std::size_t i = c >= 0 ? 0 : 2, j = s >= 0 ? 1 : 3;
  return {crown.radius_m[i] * c, crown.radius_m[j] * s, crown.rim_m[i] * c * c + crown.rim_m[j] * s * s};
}

/// The point at rho between an apex and a point of the rim.
Point surface_point(const CrownShape& crown, Vec3 apex, double shape, const Point& rim, double rho) {
  const double rest = crown.profile == CrownProfile::power ? 1 - std::pow(rho, shape)
                                                           : std::pow(1 - std::pow(rho, shape), 1 / shape);
  return {apex.x + (rim.x - apex.x) * rho, apex.y + (rim.y - apex.y) * rho, rim.z + (apex.z - rim.z) * rest};
}

TEST(CrownEnvelope, ItsRimIsOnBothSurfaces) {
  const CrownShape shape = lopsided();
  const CrownEnvelope crown(shape);
  for (int k = 0; k < 720; ++k) {
    const Point rim = rim_point(shape, 2 * std::numbers::pi * k / 720);
    const auto heights = crown.heights_m(rim.x * (1 - 1e-9), rim.y * (1 - 1e-9));
    ASSERT_TRUE(heights) << k;
    EXPECT_NEAR(heights->lower_m, rim.z, 1e-3) << k;
    EXPECT_NEAR(heights->upper_m, rim.z, 1e-3) << k;
    EXPECT_FALSE(crown.heights_m(rim.x * (1 + 1e-6), rim.y * (1 + 1e-6))) << k;
  }
}

void expect_parametric_points_on(const CrownShape& shape) {
  const CrownEnvelope crown(shape);
  for (int k = 0; k < 20000; ++k) {
    const Point rim = rim_point(shape, 2 * std::numbers::pi * std::fmod(k * 0.618, 1.0));
    const double rho = std::fmod(k * 0.7548, 1.0);
    const Point above = surface_point(shape, shape.top_m, shape.shape_above, rim, rho),
                below = surface_point(shape, shape.bottom_m, shape.shape_below, rim, rho);
    ASSERT_NEAR(crown.heights_m(above.x, above.y).value().upper_m, above.z, 1e-6) << k;
    ASSERT_NEAR(crown.heights_m(below.x, below.y).value().lower_m, below.z, 1e-6) << k;
  }
}

TEST(CrownEnvelope, FortyThousandParametricPointsAreOnTheImplicitSurface) {
  expect_parametric_points_on(lopsided());
}

TEST(CrownEnvelope, InPowerModeThePointsThatPlantglDrawsAreOnIt) {
  CrownShape shape = lopsided();
  shape.profile = CrownProfile::power;
  expect_parametric_points_on(shape);
}

TEST(CrownEnvelope, OfEllipsesAboutAPointItIsABall) {
  const CrownEnvelope crown(unit_ball());
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(-1, 1);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 point{unit(random), unit(random), unit(random)};
    if (std::fabs(length(point) - 1) > 1e-6f) {
      ASSERT_EQ(crown.contains(point), length(point) < 1);
    }
    ASSERT_NEAR(crown.signed_distance_m(point), length(point) - 1, 1e-3);
    const Vec3 direction = normalized({unit(random), unit(random), unit(random)});
    const Vec3 start = point * 0.5f;
    ASSERT_NEAR(length(start + direction * crown.reach_m(start, direction)), 1, 1e-4);
  }
}

TEST(CrownEnvelope, TheShapesNamedInTheHeaderAreWhatTheyAreCalled) {
  CrownShape shape = unit_ball();
  const auto radius_at = [&](float z) { return CrownEnvelope(shape).reach_m({0, 0, z}, {1, 0, 0}); };
  shape.shape_above = shape.shape_below = 1;
  EXPECT_NEAR(radius_at(0.6f), 0.4f, 1e-4);  // a cone
  shape.shape_above = shape.shape_below = 60;
  EXPECT_NEAR(radius_at(0.9f), 1, 1e-3);  // a cylinder
  shape.shape_above = 0.5f;
  EXPECT_LT(radius_at(0.6f), 0.1f);  // hollow
  shape.profile = CrownProfile::power;
  shape.shape_above = 2;
  EXPECT_NEAR(radius_at(0.6f), std::sqrt(0.4f), 1e-4);  // a paraboloid
}

RC_GTEST_PROP(CrownEnvelope, ItContainsWhatLiesBetweenItsHeights, ()) {
  const CrownEnvelope crown(any_crown());
  const auto number = [] { return static_cast<float>(*rc::gen::inRange(-5000, 5001)) / 1000; };
  const Vec3 point{number(), number(), number() + 6};
  const auto heights = crown.heights_m(point.x, point.y);
  const bool is_between = heights && heights->lower_m < point.z && point.z < heights->upper_m;
  const bool is_near = heights && std::min(std::fabs(heights->lower_m - double{point.z}),
                                           std::fabs(heights->upper_m - double{point.z})) < 1e-5;
  if (!is_near) RC_ASSERT(crown.contains(point) == is_between);
  if (heights && !is_near) RC_ASSERT(crown.is_under_top(point) == (point.z < heights->upper_m));
  if (!heights) RC_ASSERT(!crown.is_under_top(point));
  if (std::fabs(crown.signed_distance_m(point)) > 1e-4f)
    RC_ASSERT(crown.contains(point) == (crown.signed_distance_m(point) < 0));
}

RC_GTEST_PROP(CrownEnvelope, AReachEndsAtTheSurface, ()) {
  const CrownShape shape = any_crown();
  const CrownEnvelope crown(shape);
  const float share = static_cast<float>(*rc::gen::inRange(10, 91)) / 100;
  const Vec3 start = lerp(shape.bottom_m, shape.top_m, share), direction = any_direction();
  RC_PRE(crown.contains(start));
  const Vec3 end = start + direction * crown.reach_m(start, direction);
  RC_ASSERT(std::fabs(crown.signed_distance_m(end)) < 1e-3f * (shape.top_m.z - shape.bottom_m.z));
}

RC_GTEST_PROP(CrownEnvelope, ARayLeavesAConvexCrownOnceAndThatIsItsReach, ()) {
  CrownShape shape = any_crown();
  shape.rim_m.fill(shape.rim_m[0]);
  const CrownEnvelope crown(shape);
  const float share = static_cast<float>(*rc::gen::inRange(10, 91)) / 100;
  const Vec3 start = lerp(shape.bottom_m, shape.top_m, share), direction = any_direction();
  RC_PRE(crown.signed_distance_m(start) < -0.1f);
  const float reach_m = crown.reach_m(start, direction);
  for (const float before : {0.2f, 0.5f, 0.8f, 0.995f})
    RC_ASSERT(crown.contains(start + direction * (reach_m * before)));
  for (const float beyond : {1.005f, 1.2f, 2.f})
    RC_ASSERT(!crown.contains(start + direction * (reach_m * beyond)));
}

TEST(CrownEnvelope, ARayInAHollowCrownReachesToWhereItLeavesFirst) {
  CrownShape shape = unit_ball();
  shape.shape_above = 0.5f;  // above at ρ: (1 − √ρ)²
  const CrownEnvelope crown(shape);
  const Vec3 start{0, 0, 0.9f}, direction = normalized({1, 0, -1});
  // The line z = 0.9 − ρ meets it at √ρ = (1 ± √0.8)/2, and is inside again from the second place on.
  const float first = std::pow((1 - std::sqrt(0.8f)) / 2, 2.f);
  EXPECT_NEAR(crown.reach_m(start, direction), first * std::numbers::sqrt2_v<float>, 1e-4);
}

RC_GTEST_PROP(CrownEnvelope, ABallThatSurelyLiesInsideDoes, ()) {
  const CrownShape shape = any_crown();
  const CrownEnvelope crown(shape);
  const float share = static_cast<float>(*rc::gen::inRange(5, 96)) / 100;
  const Vec3 center = lerp(shape.bottom_m, shape.top_m, share);
  float radius = 0, too_large = 20;  // of the largest such ball
  for (int i = 0; i < 20; ++i) {
    const float middle = (radius + too_large) / 2;
    (crown.surely_contains_ball(center, middle) ? radius : too_large) = middle;
  }
  for (const Vec3 direction : many_directions())
    RC_ASSERT(crown.contains(center + direction * (radius * 0.999f)));
}

TEST(CrownEnvelope, BallsUnderALowRimAndOverAHighOneAreNotTakenToLieInside) {
  const CrownEnvelope crown({.top_m = {0, 0, 2},
                             .bottom_m = {0, 0, 0},
                             .radius_m = {1, 1, 1, 1},
                             .rim_m = {0.1f, 1, 1.9f, 1},
                             .shape_above = 1,
                             .shape_below = 1});
  EXPECT_FALSE(crown.contains({0.5f, 0, 1.15f}));
  EXPECT_FALSE(crown.surely_contains_ball({0.3f, 0, 1}, 0.3f));
  EXPECT_FALSE(crown.contains({-0.5f, 0, 0.85f}));
  EXPECT_FALSE(crown.surely_contains_ball({-0.3f, 0, 1}, 0.3f));
}

TEST(CrownEnvelope, RaysToSharpEdgesReachThemAsWell) {
  CrownShape shape = lopsided();
  shape.shape_above = shape.shape_below = 9;
  for (const CrownProfile profile : {CrownProfile::superellipse, CrownProfile::power}) {
    shape.profile = profile;
    const CrownEnvelope crown(shape);
    for (const Vec3 direction : many_directions()) {
      const Vec3 start{0, 0, 0.4f}, end = start + direction * crown.reach_m(start, direction);
      EXPECT_LT(std::fabs(crown.signed_distance_m(end)), 1e-3f);
    }
  }
}

TEST(CrownEnvelope, BallsWellInsideAreKnownToBe) {
  const CrownEnvelope crown(unit_ball());
  EXPECT_TRUE(crown.surely_contains_ball({0, 0, 0}, 0.69f));
  EXPECT_TRUE(crown.surely_contains_ball({0.3f, 0, 0.2f}, 0.3f));
  EXPECT_FALSE(crown.surely_contains_ball({0, 0, 0}, 1.01f));
}

TEST(CrownEnvelope, ARayFromOutsideReachesToItsFarSide) {
  const CrownEnvelope crown(unit_ball());
  EXPECT_NEAR(crown.reach_m({0, 0, -3}, {0, 0, 1}), 4, 1e-4);
  EXPECT_EQ(crown.reach_m({0, 0, -3}, {1, 0, 0}), 0);
  EXPECT_EQ(crown.reach_m({0, 0, -3}, {0, 0, -1}), 0);
}

std::string crown_error(const std::string& text) {
  try {
    parse_volume(text);
    return "none";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(CrownText, NumbersWithoutASideAreThoseOfAllSides) {
  const auto crown = parse_volume("crown(top = 9, radius = 3, rim_left = 2, rim = 4, shape = 1, bottom = 1)");
  EXPECT_TRUE(crown->contains({2.9f, 0, 4}));
  EXPECT_TRUE(crown->contains({-2.9f, 0, 2}));
  EXPECT_FALSE(crown->contains({-2.9f, 0, 4}));
  EXPECT_FALSE(crown->contains({2.0f, 0, 6}));  // of a cone
  EXPECT_FALSE(crown->contains({0, 0, 0.9f}));
}

TEST(CrownText, WithoutARimAndABottomItStandsOnTheGroundAndIsWidestInTheMiddle) {
  const auto crown = parse_volume("crown(top = 8, radius = 3)");
  EXPECT_TRUE(crown->contains({2.99f, 0, 4}));
  EXPECT_TRUE(crown->contains({0, 0, 0.01f}));
  EXPECT_FALSE(crown->contains({2.99f, 0, 5}));
}

TEST(CrownText, ErrorsSayWhereWhatWasGotAndExpected) {
  const std::pair<const char*, const char*> faults[] = {
      {"crown(top = 1, bottom = 2, radius = 1)",
       "column 1: crown: top is 1, expected more than its bottom, 2"},
      {"crown(top = 9, radius = -3)", "crown: radius to the right is -3, expected a positive number"},
      {"crown(top = 9, radius = 3, radius_front = 0)", "radius to the front is 0"},
      {"crown(top = 9, radius = nan)", "column 25: 'nan' is not a finite number"},
      {"crown(top = 9, radius = 3, shape = 0)", "crown: shape above is 0, expected 0.1 .. 100"},
      {"crown(top = 9, radius = 3, shape_below = 0)", "crown: shape below is 0"},
      {"crown(top = 9, radius = 3, rim = 10)",
       "crown: rim at the right is 10, expected from bottom to top, 0 .. 9"},
      {"crown(top = 9, radius = 3, top_x = 4)", "crown: top is 1.33 times as far out as the rim"},
      {"crown(radius = 3)", "crown: got no top"},
      {"crown(top = 9, radius_left = 3)", "crown: got no radius of some side"},
      {"crown(top = 9, radius = 3, hight = 3)", "column 28: got 'hight', expected one of top, top_x"},
      {"crown(top = 9, radius = 3, top = 3)", "column 28: got a second 'top'"},
      {"crown(top 9)", "column 11: got '9', expected '=' after 'top'"},
      {"crown(top = 9, radius = 3, profile = round)",
       "got profile 'round', expected one of superellipse, power"},
      {"crown(top = , radius = 3)", "column 13: got ',', expected a number"},
      {"crown()", "column 7: got '', expected one of top"},
      {"crown(top = 9, radius = 3", "expected ')'"}};
  for (const auto& [fault, expected] : faults) EXPECT_THAT(crown_error(fault), HasSubstr(expected)) << fault;
}

}  // namespace
}  // namespace espalier
