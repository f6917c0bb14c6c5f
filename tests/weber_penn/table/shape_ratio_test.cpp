// Laws of the crown shapes and of the pruning envelope, against the formulas of the papers.
#include <gtest/gtest.h>

#include <cmath>

#include <espalier/core/random.h>
#include <espalier/weber_penn/table/shape_ratio.h>

namespace espalier {
namespace {

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

TEST(MixedCrown, LiesBetweenItsTwoShapes) {
  WeberPennParameters crown;
  crown.shape = 0;
  crown.shape_2 = 3;
  crown.shape_mix = 0.25f;
  for (const float ratio : {0.f, 0.3f, 0.8f, 1.f}) {
    const float conical = shape_ratio(0, ratio, crown), cylindrical = shape_ratio(3, ratio, crown);
    EXPECT_FLOAT_EQ(crown_shape_ratio(ratio, crown), 0.75f * conical + 0.25f * cylindrical);
  }
  crown.shape_mix = 0;
  EXPECT_EQ(crown_shape_ratio(0.3f, crown), shape_ratio(0, 0.3f, crown));
}

}  // namespace
}  // namespace espalier
