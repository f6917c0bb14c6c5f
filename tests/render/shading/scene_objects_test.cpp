// What stands beside a plant in a shaded picture: it is seen, hides, and throws shadows.
#include <gtest/gtest.h>

#include <espalier/render/shading/shaded.h>

#include "support/hand_made_plants.h"

namespace espalier {
namespace {

/// An upright wall that faces the viewer.
SceneObjects wall(float left_m, float right_m, float y_m, float top_m) {
  return {{{left_m, y_m, 0}, {right_m, y_m, 0}, {right_m, y_m, top_m}, {left_m, y_m, top_m}},
          {{0, 1, 2}, {0, 2, 3}}};
}

Plant post() {
  Plant plant;
  add_cylinder(plant, {0, 0, 0}, {0, 0, 2}, 0.2f);
  return plant;
}

int sum_of(Rgb c) { return c.r + c.g + c.b; }

TEST(SceneObjects, AreInTheBoxOfTheScene) {
  const Bounds box = bounds(post(), wall(1, 3, 2, 4));
  EXPECT_NEAR(box.lower.x, -0.2f, 1e-3f);
  EXPECT_EQ(box.upper.x, 3);
  EXPECT_EQ(box.upper.y, 2);
  EXPECT_EQ(box.upper.z, 4);
}

TEST(SceneObjects, AreSeenWhereTheyStandAndNowhereElse) {
  const Plant plant = post();
  const SceneObjects objects = wall(1, 2, 0, 2);
  const Camera camera = frame_bounds({{-2, 0, 0}, {2, 0, 2}}, {}, 64, 64);
  const Picture without = render_shaded(plant, camera), with = render_shaded(plant, camera, {}, objects);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const float x_m = (static_cast<float>(x) + 0.5f - 32) * camera.metres_per_px;
      const float z_m = 1 - (static_cast<float>(y) + 0.5f - 32) * camera.metres_per_px;
      const float edge_m = camera.metres_per_px;
      const bool is_wall = x_m > 1 + edge_m && x_m < 2 - edge_m && z_m > edge_m && z_m < 2 - edge_m;
      const bool is_sky = x_m < -0.3f || x_m > 2 + edge_m || (x_m > 0.3f && x_m < 1 - edge_m);
      if (is_wall || is_sky) {
        EXPECT_EQ(with.at(x, y) != without.at(x, y), is_wall) << x << "," << y;
      }
    }
}

TEST(SceneObjects, HideWhatIsBehindThem) {
  const Plant plant = post();
  const Camera camera = frame_bounds({{-2, 0, 0}, {2, 0, 2}}, {}, 64, 64);
  const Rgb bare = render_shaded(plant, camera).at(32, 32);
  EXPECT_NE(render_shaded(plant, camera, {}, wall(-1, 1, -1, 2)).at(32, 32), bare) << "before the post";
  ShadedSettings settings;
  settings.sun_elevation_deg = 0;
  const Rgb lit = render_shaded(plant, camera, settings).at(32, 32);
  EXPECT_LT(sum_of(render_shaded(plant, camera, settings, wall(-9, -0.5f, -1, 2)).at(32, 32)), sum_of(lit))
      << "between the post and the sun";
}

}  // namespace
}  // namespace espalier
