// Both renderers draw the same silhouette: all species, any direction, both projections, odd sizes. They may
// differ on edge pixels only, and rarely.
#include <gtest/gtest.h>

#include <espalier/models/models.h>
#include <espalier/models/preset.h>
#include <espalier/render/embree/embree_renderer.h>
#include <espalier/render/scanlines/scanline_renderer.h>
#include <espalier/render/silhouette.h>

#include "support/hand_made_plants.h"

namespace espalier {
namespace {

Plant grown(const std::string& species, Seed seed) {
  const Preset preset = load_preset(species);
  Plant plant;
  model_by_name(preset.model).generate(preset.values, seed, {}, plant);
  return plant;
}

struct Difference {
  std::size_t pixels = 0, of_set = 0;
};

Difference difference(const Plant& plant, const Camera& camera) {
  Mask traced, scanned;
  make_embree_renderer()->draw(plant, camera, traced);
  make_scanline_renderer()->draw(plant, camera, scanned);
  return {differing_px(traced, scanned), area_px(traced)};
}

Camera camera_of(const Plant& plant, const View& view, int width_px, int height_px) {
  return frame_bounds(bounds(plant), view, width_px, height_px);
}

class RenderersAgree : public testing::TestWithParam<std::string> {};

/// Where twigs are a hundredth of a pixel wide, the last digit decides which pixels they meet.
TEST_P(RenderersAgree, OnASpeciesUpToAFewEdgePixels) {
  const Plant plant = grown(GetParam(), 1);
  const Difference d = difference(plant, camera_of(plant, {}, 256, 256));
  EXPECT_GT(d.of_set, 1000u);
  EXPECT_LE(d.pixels, d.of_set / 150 + 1);
}

INSTANTIATE_TEST_SUITE_P(Species, RenderersAgree, testing::ValuesIn(bundled_presets()),
                         [](const auto& test) { return test.param; });

TEST(RenderersAgree, OnTheBenchedSpeciesUpToAThousandthOfTheirPixels) {
  for (const char* species : {"quaking_aspen", "lombardy_poplar", "small_pine", "palm", "weeping_willow"}) {
    const Plant plant = grown(species, 1);
    const Difference d = difference(plant, camera_of(plant, {}, 256, 256));
    EXPECT_LE(d.pixels, d.of_set / 1000) << species;
  }
}

TEST(RenderersAgree, FromAnyDirectionInBothProjections) {
  for (int i = 0; i < 24; ++i) {
    View view;
    view.azimuth_deg = 15.0f * static_cast<float>(i);
    view.elevation_deg = -80.0f + 7.0f * static_cast<float>(i);
    view.projection = i % 2 == 0 ? Projection::orthographic : Projection::perspective;
    view.field_of_view_deg = 20.0f + 3.0f * static_cast<float>(i);
    const Plant plant = random_tree(300, 1000, static_cast<Seed>(i));
    const Difference d = difference(plant, camera_of(plant, view, 64 + 37 * i, 128));
    EXPECT_LE(d.pixels, d.of_set / 50 + 2) << i;
  }
}

TEST(RenderersAgree, OnEveryLeafAndBlossom) {
  for (int shape = 1; shape <= 13; ++shape) {
    Plant plant;
    const bool is_blossom = shape > 10;
    plant.leaf_shape = is_blossom ? 1 : shape;
    plant.blossom_shape = is_blossom ? shape - 10 : 1;
    const LeafKind kind = is_blossom ? LeafKind::blossom : LeafKind::leaf;
    for (std::uint32_t i = 0; i < 12; ++i) {
      const Vec3 axis = random_direction(root_key(1), 2 * i);
      const Vec3 side = normalized(cross(axis, random_direction(root_key(1), 2 * i + 1)));
      add_leaf(plant, random_direction(root_key(2), i) * 8.0f, axis, side, 5, 3, kind);
    }
    const Difference d = difference(plant, camera_of(plant, {}, 300, 300));
    EXPECT_GT(d.of_set, 2000u) << shape;
    EXPECT_LE(d.pixels, 8u) << shape;
  }
}

TEST(RenderersAgree, OnStemsThatPointAtTheViewer) {
  for (const float slant : {0.0f, 0.02f, 0.3f, 1.0f, 5.0f}) {
    Plant plant;
    add_cylinder(plant, {0, -3, 0}, {slant, 3, 0.4f * slant}, 1);
    const Difference d = difference(plant, camera_of(plant, {}, 128, 128));
    EXPECT_GT(d.of_set, 500u);
    EXPECT_LE(d.pixels, 8u) << slant;
  }
}

TEST(RenderersAgree, OnPlantsThatReachBeyondTheFrame) {
  const Plant plant = random_tree(200, 600, 5);
  Camera camera = camera_of(plant, {}, 200, 150);
  camera.metres_per_px *= 0.2f;
  const Difference d = difference(plant, camera);
  EXPECT_GT(d.of_set, 500u);
  EXPECT_LE(d.pixels, d.of_set / 50 + 2);
}

TEST(RenderersAgree, OnNothing) { EXPECT_EQ(difference({}, camera_of({}, {}, 65, 3)).pixels, 0u); }

}  // namespace
}  // namespace espalier
