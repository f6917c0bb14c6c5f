// Laws of taper and flare, against the formulas of the papers.
#include <gtest/gtest.h>

#include <cmath>

#include <espalier/weber_penn/scalar/stem.h>

namespace espalier {
namespace {

GrowingStem stem_of(int level) {
  GrowingStem stem;
  stem.level = level;
  stem.length_m = 4;
  stem.radius_m = 0.2f;
  return stem;
}

float radius_m(float taper, float z, float flare = 0, int level = 1) {
  WeberPennParameters parameters;
  parameters.taper = {taper, taper, taper, taper};
  parameters.flare = flare;
  return stem_radius_m(stem_of(level), z, parameters);
}

TEST(Taper, ZeroIsACylinder) { EXPECT_FLOAT_EQ(radius_m(0, 0.9f), 0.2f); }

TEST(Taper, BelowOneEndsAtThatFractionLess) { EXPECT_FLOAT_EQ(radius_m(0.6f, 1), 0.2f * 0.4f); }

TEST(Taper, OneIsACone) {
  EXPECT_FLOAT_EQ(radius_m(1, 0.5f), 0.1f);
  EXPECT_NEAR(radius_m(1, 1), 0, 1e-6);
}

TEST(Taper, TwoEndsInAHemisphere) {
  EXPECT_FLOAT_EQ(radius_m(2, 0.5f), 0.2f);
  const float to_tip_m = 0.05f;  // a sphere of radius 0.2 centred 0.2 before the tip
  EXPECT_NEAR(radius_m(2, 1 - to_tip_m / 4), std::sqrt(0.04 - 0.15 * 0.15), 1e-4);
}

TEST(Taper, ThreeIsARowOfSpheres) {
  EXPECT_NEAR(radius_m(3, 0.5f), 0, 1e-3);            // 2 m from the tip: five diameters, where spheres touch
  EXPECT_NEAR(radius_m(3, 1 - 0.2f / 4), 0.2, 1e-3);  // the middle of the last sphere
}

TEST(Flare, WidensTheFootOfTrunksOnly) {
  EXPECT_NEAR(radius_m(0, 0, 0.6f, 0), 0.2 * (1 + 0.6 * 0.99), 1e-5);
  EXPECT_NEAR(radius_m(0, 0.125f, 0.6f, 0), 0.2, 1e-5);
  EXPECT_NEAR(radius_m(0, 0, 0.6f, 1), 0.2, 1e-6);
}

}  // namespace
}  // namespace espalier
