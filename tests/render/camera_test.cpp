// Laws of cameras: rays and projections agree, views are orthonormal, frames hold what they must hold.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include <espalier/render/camera.h>

namespace espalier {
namespace {

View any_view() {
  View view;
  view.azimuth_deg = static_cast<float>(*rc::gen::inRange(-360, 361));
  view.elevation_deg = static_cast<float>(*rc::gen::inRange(-90, 91));
  view.projection = *rc::gen::element(Projection::orthographic, Projection::perspective);
  view.field_of_view_deg = static_cast<float>(*rc::gen::inRange(10, 100));
  return view;
}

float any_metres(int lower, int upper) {
  return 0.1f * static_cast<float>(*rc::gen::inRange(10 * lower, 10 * upper));
}

Bounds any_box() {
  const Vec3 lower{any_metres(-9, 9), any_metres(-9, 9), any_metres(-9, 9)};
  return {lower, lower + Vec3{any_metres(0, 20), any_metres(0, 20), any_metres(1, 20)}};
}

Vec3 corner(const Bounds& box, int i) {
  return {i & 1 ? box.upper.x : box.lower.x, i & 2 ? box.upper.y : box.lower.y,
          i & 4 ? box.upper.z : box.lower.z};
}

void expect_near(Vec3 got, Vec3 expected) { EXPECT_LT(length(got - expected), 1e-5f); }

TEST(Camera, TheFrontViewLooksAlongPlusY) {
  const Camera camera = frame_bounds({{-1, -1, 0}, {1, 1, 2}}, {}, 64, 64);
  expect_near(camera.forward, {0, 1, 0});
  expect_near(camera.right, {1, 0, 0});
  expect_near(camera.up, {0, 0, 1});
}

TEST(Camera, Azimuth90LooksAlongMinusX) {
  View view;
  view.azimuth_deg = 90;
  const Camera camera = frame_bounds({{-1, -1, 0}, {1, 1, 2}}, view, 64, 64);
  expect_near(camera.forward, {-1, 0, 0});
  expect_near(camera.right, {0, 1, 0});
}

TEST(Camera, PositiveElevationLooksDown) {
  View view;
  view.elevation_deg = 90;
  const Camera camera = frame_bounds({{-1, -1, 0}, {1, 1, 2}}, view, 64, 64);
  expect_near(camera.forward, {0, 0, -1});
  EXPECT_GT(camera.position_m.z, 2);
}

TEST(Camera, ViewsAreOrthonormal) {
  EXPECT_TRUE(rc::check([] {
    const Camera camera = frame_bounds(any_box(), any_view(), 64, 64);
    RC_ASSERT(std::fabs(dot(camera.right, camera.up)) < 1e-5f);
    RC_ASSERT(std::fabs(length(camera.up) - 1) < 1e-5f);
    RC_ASSERT(length(cross(camera.right, camera.forward) - camera.up) < 1e-5f);
  }));
}

TEST(Camera, ProjectInvertsCameraRay) {
  EXPECT_TRUE(rc::check([] {
    const Camera camera = frame_bounds(any_box(), any_view(), 200, 100);
    const float x = static_cast<float>(*rc::gen::inRange(0, 200)),
                y = static_cast<float>(*rc::gen::inRange(0, 100));
    const Ray ray = camera_ray(camera, x, y);
    const PicturePoint p = project(camera, ray.origin_m + ray.direction * 7.0f);
    RC_ASSERT(std::fabs(p.x_px - x) < 0.02f);
    RC_ASSERT(std::fabs(p.y_px - y) < 0.02f);
    RC_ASSERT(p.depth_m > 0);
  }));
}

TEST(Camera, RightOfThePictureIsRightAndTopIsUp) {
  const Camera camera = frame_bounds({{-1, -1, 0}, {1, 1, 2}}, {}, 64, 64);
  EXPECT_GT(project(camera, {1, 0, 1}).x_px, project(camera, {0, 0, 1}).x_px);
  EXPECT_LT(project(camera, {0, 0, 2}).y_px, project(camera, {0, 0, 1}).y_px);
}

TEST(FrameBounds, HoldsTheBoxWithItsMargin) {
  EXPECT_TRUE(rc::check([] {
    const Bounds box = any_box();
    const int width = *rc::gen::inRange(16, 500), height = *rc::gen::inRange(16, 500);
    const Camera camera = frame_bounds(box, any_view(), width, height, 1.1f);
    for (int i = 0; i < 8; ++i) {
      const PicturePoint p = project(camera, corner(box, i));
      RC_ASSERT(p.depth_m > 0);
      RC_ASSERT(p.x_px > 0.04f * width && p.x_px < 0.96f * width);
      RC_ASSERT(p.y_px > 0.04f * height && p.y_px < 0.96f * height);
    }
  }));
}

TEST(FrameBounds, TheLargerSideFillsTheFrameUpToTheMargin) {
  const Camera camera = frame_bounds({{-1, -1, 0}, {1, 1, 8}}, {}, 100, 100, 1.25f);
  EXPECT_NEAR(camera.metres_per_px * 100, 8 * 1.25f, 1e-5f);
}

TEST(FrameBounds, APointGetsAFrameOneMetreHigh) {
  const Camera camera = frame_bounds({{3, 3, 3}, {3, 3, 3}}, {}, 40, 50);
  EXPECT_NEAR(camera.metres_per_px * 50, 1, 1e-5f);
  EXPECT_NEAR(project(camera, {3, 3, 3}).x_px, 20, 1e-3f);
}

TEST(FrameBase, PutsTheBaseOnItsRowAndKeepsTheScaleThere) {
  EXPECT_TRUE(rc::check([] {
    const Vec3 base{any_metres(-5, 5), any_metres(-5, 5), any_metres(-5, 5)};
    const Camera camera = frame_base(base, any_view(), 0.05f, 128, 96, 90);
    const PicturePoint p = project(camera, base);
    RC_ASSERT(std::fabs(p.x_px - 64) < 0.01f);
    RC_ASSERT(std::fabs(p.y_px - 90) < 0.01f);
    RC_ASSERT(p.depth_m > 0);
    RC_ASSERT(std::fabs(project(camera, base + camera.up).y_px - 70) < 0.02f);
    RC_ASSERT(std::fabs(project(camera, base + camera.right).x_px - 84) < 0.02f);
  }));
}

}  // namespace
}  // namespace espalier
