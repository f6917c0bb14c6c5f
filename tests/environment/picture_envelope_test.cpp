// The volume that pictures leave to a tree.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include <espalier/core/error.h>
#include <espalier/environment/picture_envelope.h>

namespace espalier {
namespace {

constexpr int kSize = 64;

Camera camera_at(float azimuth_deg) {
  return frame_base({0, 0, 0}, {.azimuth_deg = azimuth_deg}, 0.1f, kSize, kSize, 60);
}

/// A disc on a stick, its middle at (32, 25), radius 18.
Mask lollipop() {
  Mask mask(kSize, kSize);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x)
      if (std::hypot(x - 31.5, y - 25) < 18 || (y < 60 && y > 25 && std::abs(x - 31.5) < 3)) mask.set(x, y);
  return mask;
}

Vec3 any_point(float reach_m) {
  const auto number = [&](float from, float to) {
    return from + (to - from) * static_cast<float>(*rc::gen::inRange(0, 10'001)) / 10'000;
  };
  return {number(-reach_m, reach_m), number(-reach_m, reach_m), number(-1, 6)};
}

RC_GTEST_PROP(PictureEnvelope, APointInsideIsSeenInsideOfTheOutline, ()) {
  const Mask mask = lollipop();
  const auto volume = make_picture_envelope({{camera_at(0), mask}});
  const Vec3 point = any_point(3);
  const PicturePoint seen = project(camera_at(0), point);
  const int x = static_cast<int>(std::floor(seen.x_px)), y = static_cast<int>(std::floor(seen.y_px));
  const bool is_seen_inside = x >= 0 && y >= 0 && x < kSize && y < kSize && mask.get(x, y);
  if (volume->contains(point)) RC_ASSERT(is_seen_inside);
  if (is_seen_inside) RC_ASSERT(volume->contains({point.x, 0, point.z}));
}

RC_GTEST_PROP(PictureEnvelope, ABallThatIsSurelyInsideHasAllItsPointsInside, ()) {
  const auto volume = make_picture_envelope({{camera_at(0), lollipop()}});
  const Vec3 center = any_point(1) * 0.6f + Vec3{0, 0, 2};
  const float radius = static_cast<float>(*rc::gen::inRange(0, 100)) / 80;
  const Vec3 direction = normalized(any_point(1) - Vec3{0, 0, 2.5f});
  const bool surely_inside = volume->surely_contains_ball(center, radius);
  RC_CLASSIFY(surely_inside);
  if (surely_inside) RC_ASSERT(volume->contains(center + direction * radius));
}

TEST(PictureEnvelope, KnowsThatASmallBallInTheMiddleIsInside) {
  const auto volume = make_picture_envelope({{camera_at(0), lollipop()}});
  EXPECT_TRUE(volume->surely_contains_ball({0, 0, 3.5f}, 1));
  EXPECT_FALSE(volume->surely_contains_ball({0, 0, 3.5f}, 2));
}

TEST(PictureEnvelope, OnePictureLimitsDepthByHalfTheWidthAtThatHeight) {
  const auto volume = make_picture_envelope({{camera_at(0), lollipop()}});
  const float crown_m = (60 - 25) * 0.1f;
  EXPECT_TRUE(volume->contains({0, 1.7f, crown_m}));
  EXPECT_FALSE(volume->contains({0, 1.9f, crown_m}));
  EXPECT_TRUE(volume->contains({0, 0.25f, 0.5f}));
  EXPECT_FALSE(volume->contains({0, 0.5f, 0.5f}));
}

TEST(PictureEnvelope, TwoPicturesLeaveTheirVisualHull) {
  Mask stick(kSize, kSize);
  for (int y = 10; y < 60; ++y)
    for (int x = 30; x < 34; ++x) stick.set(x, y);
  const auto volume = make_picture_envelope({{camera_at(0), lollipop()}, {camera_at(90), stick}});
  const float crown_m = (60 - 25) * 0.1f;
  EXPECT_TRUE(volume->contains({1.5f, 0, crown_m}));
  EXPECT_FALSE(volume->contains({0, 1.5f, crown_m}));
}

TEST(PictureEnvelope, AnEmptyOutlineIsRefused) {
  EXPECT_THROW(make_picture_envelope({{camera_at(0), Mask(kSize, kSize)}}), InputError);
}

}  // namespace
}  // namespace espalier
