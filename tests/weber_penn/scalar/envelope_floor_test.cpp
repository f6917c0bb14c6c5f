// What the floor under the pruning envelope holds, the envelope holds; and it lies close below.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <espalier/weber_penn/scalar/envelope_floor.h>
#include <espalier/weber_penn/table/shape_ratio.h>

namespace espalier {
namespace {

float in_range(float low, float high) {
  return low + (high - low) * static_cast<float>(*rc::gen::inRange(0, 10'001)) * 1e-4f;
}

WeberPennParameters any_envelope() {
  WeberPennParameters p = weber_penn_parameters(weber_penn_table().defaults());
  p.base_size[0] = in_range(0, 0.9f);
  p.prune_width = in_range(0, 1);
  p.prune_width_peak = in_range(0, 1);
  p.prune_power_low = in_range(0, 2);
  p.prune_power_high = in_range(0, 2);
  return p;
}

TEST(EnvelopeFloor, HoldsNothingThatTheEnvelopeDoesNot) {
  EXPECT_TRUE(rc::check([] {
    const WeberPennParameters p = any_envelope();
    const EnvelopeFloor floor(p);
    for (int i = 0; i < 100; ++i) {
      const Vec3 center_m{in_range(-6, 6), in_range(-6, 6), in_range(-1, 12)};
      const float radius_m = in_range(0, 2);
      if (floor.surely_holds_ball(center_m, radius_m, 10))
        RC_ASSERT(ball_inside_envelope(center_m, radius_m, 10, p));
    }
  }));
}

TEST(EnvelopeFloor, HoldsMostOfWhatTheEnvelopeDoes) {
  WeberPennParameters p = weber_penn_parameters(weber_penn_table().defaults());
  p.prune_width = 0.4f;
  p.prune_width_peak = 0.6f;
  p.prune_power_low = 0.001f;
  p.prune_power_high = 0.5f;
  const EnvelopeFloor floor(p);
  int inside = 0, held = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 center_m{0.003f * static_cast<float>(i), 0, 0.01f * static_cast<float>(i)};
    inside += ball_inside_envelope(center_m, 0.3f, 10, p);
    held += floor.surely_holds_ball(center_m, 0.3f, 10);
  }
  EXPECT_GT(inside, 100);
  EXPECT_GE(held, 9 * inside / 10);
}

}  // namespace
}  // namespace espalier
