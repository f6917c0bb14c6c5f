// Laws of taper, flare and the crown shapes, against the formulas of the papers.
#include <gtest/gtest.h>

#include <cmath>

#include <espalier/core/random.h>
#include <espalier/weber_penn/scalar/stem.h>
#include <espalier/weber_penn/table/shape_ratio.h>

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

TEST(ShapeRatio, FollowsTheTableOfThePaper) {
  const WeberPennParameters p;
  const float expected_at_half[] = {
      0.6f, 1, 0.2f + 0.8f * std::sqrt(0.5f), 1, 0.75f, 0.5f / 0.7f, 0.6f, 0.5f + 0.25f / 0.7f};
  for (int shape = 0; shape < 8; ++shape)
    EXPECT_NEAR(shape_ratio(shape, 0.5f, p), expected_at_half[shape], 1e-6);
}

TEST(Envelope, IsWidestAtItsPeakAndEmptyOutside) {
  WeberPennParameters p;
  p.prune_width_peak = 0.5f;
  EXPECT_FLOAT_EQ(shape_ratio(8, 0.5f, p), 1);
  EXPECT_FLOAT_EQ(shape_ratio(8, -0.01f, p), 0);
  EXPECT_FLOAT_EQ(shape_ratio(8, 1.01f, p), 0);
  EXPECT_LT(shape_ratio(8, 0.25f, p), 1);
}

/// A ball that is said to be inside has all its points inside, whatever the envelope.
TEST(Envelope, HoldsAllPointsOfABallThatIsInside) {
  int inside = 0;
  for (unsigned i = 0; i < 20'000; ++i) {
    const RandomKey key = root_key(i);
    unsigned n = 0;
    const auto draw = [&](float most) { return most * uniform_unit(key, 0, n++); };
    WeberPennParameters p{};
    p.prune_width = draw(1), p.prune_width_peak = draw(1), p.base_size[0] = draw(0.9f);
    p.prune_power_low = draw(3), p.prune_power_high = draw(3);
    const Vec3 center{draw(3), draw(3), draw(10)};
    const float radius = draw(2);
    if (!ball_inside_envelope(center, radius, 10, p)) continue;
    ++inside;
    for (unsigned k = 0; k < 20; ++k) {
      const Vec3 to = normalized({2 * draw(1) - 1, 2 * draw(1) - 1, 2 * draw(1) - 1}, {0, 0, 1});
      ASSERT_TRUE(inside_envelope(center + to * draw(radius), 10, p)) << i;
    }
  }
  EXPECT_GT(inside, 500);
}

TEST(Envelope, HoldsTheAxisAndNotWhatIsWiderThanItsWidth) {
  WeberPennParameters p;
  p.prune_width = 0.5f;
  p.base_size[0] = 0;
  EXPECT_TRUE(inside_envelope({0, 0, 5}, 10, p));
  EXPECT_TRUE(inside_envelope({4.9f, 0, 5}, 10, p));
  EXPECT_FALSE(inside_envelope({5.1f, 0, 5}, 10, p));
}

}  // namespace
}  // namespace espalier
