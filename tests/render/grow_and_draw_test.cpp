// Leaves drawn while they grow set the pixels of the whole plant drawn afterwards.
#include <gtest/gtest.h>

#include <array>

#include <espalier/environment/volume.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>
#include <espalier/render/embree/embree_renderer.h>
#include <espalier/render/grow_and_draw.h>
#include <espalier/render/scanlines/scanline_renderer.h>

namespace espalier {
namespace {

struct Subject {
  Preset preset;
  const Model& model;
  Plant plant;

  explicit Subject(const std::string& species)
      : preset(load_preset(species)), model(model_by_name(preset.model)) {
    model.generate(preset.values, 3, {}, plant);
  }
  Camera camera(const View& view, int size_px) const {
    return frame_bounds(bounds(plant), view, size_px, size_px + 13);
  }
};

class GrowAndDraw : public testing::TestWithParam<std::string> {};

TEST_P(GrowAndDraw, SetsThePixelsOfTheWholePlant) {
  const Subject subject(GetParam());
  const auto renderer = make_scanline_renderer();
  for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
    const Camera front = subject.camera({.projection = projection}, 100),
                 side = subject.camera({.azimuth_deg = 70}, 301);
    Mask front_mask, side_mask, expected;
    Plant rest;
    const std::array views{SilhouetteView{&front, &front_mask}, SilhouetteView{&side, &side_mask}};
    const GrowthResult result =
        grow_and_draw(subject.model, subject.preset.values, 3, {}, *renderer, views, rest);
    EXPECT_TRUE(result.grown);
    for (const SilhouetteView& view : views) {
      renderer->draw(subject.plant, *view.camera, expected);
      EXPECT_EQ(*view.mask, expected);
    }
  }
}

/// A renderer that has no way of its own to draw leaves apart.
struct DrawsWhole : SilhouetteRenderer {
  std::unique_ptr<SilhouetteRenderer> renderer = make_scanline_renderer();
  void draw(const Plant& plant, const Camera& camera, Mask& mask) override {
    renderer->draw(plant, camera, mask);
  }
};

TEST_P(GrowAndDraw, LeavesApartAreThePlantWithoutItsStems) {
  const Subject subject(GetParam());
  const Camera camera = subject.camera({.azimuth_deg = 20}, 128);
  const auto renderer = make_scanline_renderer();
  Plant foliage = subject.plant, rest;
  foliage.stems = {};
  foliage.knots = {};
  Mask whole, leaves, mask, apart;
  renderer->draw(subject.plant, camera, whole);
  renderer->draw(foliage, camera, leaves);
  const std::array views{SilhouetteView{&camera, &mask, &apart}};
  grow_and_draw(subject.model, subject.preset.values, 3, {}, *renderer, views, rest);
  EXPECT_EQ(mask, whole);
  EXPECT_EQ(apart, leaves);
  DrawsWhole other;
  for (SilhouetteRenderer* drawing : std::array<SilhouetteRenderer*, 2>{renderer.get(), &other}) {
    drawing->draw_apart(subject.plant, camera, mask, apart);
    EXPECT_EQ(mask, whole);
    EXPECT_EQ(apart, leaves);
  }
}

INSTANTIATE_TEST_SUITE_P(Species, GrowAndDraw, testing::ValuesIn(bundled_presets()),
                         [](const auto& test) { return test.param; });

TEST(GrowAndDraw, KeepsNoLeavesOfAnAspen) {
  const Subject subject("quaking_aspen");
  const Camera camera = subject.camera({}, 64);
  Mask mask;
  Plant rest;
  const std::array views{SilhouetteView{&camera, &mask}};
  grow_and_draw(subject.model, subject.preset.values, 3, {}, *make_scanline_renderer(), views, rest);
  EXPECT_GT(subject.plant.leaves.size(), 10'000u);
  EXPECT_LT(rest.leaves.size(), 100u);
  EXPECT_EQ(rest.stems.size(), subject.plant.stems.size());
}

TEST(GrowAndDraw, RefusesTheLeavesThatGrowingAloneRefuses) {
  const Subject subject("quaking_aspen");
  const auto leaves = static_cast<double>(subject.plant.leaves.size());
  for (const double share : {0.3, 0.999, 1.001}) {
    GrowthSettings settings;
    settings.budget.max_leaves = share * leaves;
    const Camera camera = subject.camera({}, 64);
    Mask mask;
    Plant plant;
    const std::array views{SilhouetteView{&camera, &mask}};
    const GrowthResult drawn = grow_and_draw(subject.model, subject.preset.values, 3, settings,
                                             *make_scanline_renderer(), views, plant);
    const GrowthResult grown = subject.model.generate(subject.preset.values, 3, settings, plant);
    EXPECT_EQ(drawn.grown, grown.grown) << share;
    EXPECT_EQ(drawn.over_budget_factor, grown.over_budget_factor) << share;
    EXPECT_EQ(drawn.grown, share > 1) << share;
  }
}

TEST(GrowAndDraw, DrawsTrainedTreesWithTheLeavesThatStay) {
  const Subject subject("quaking_aspen");
  const auto ball = make_ball({0, 0, 7}, 4);
  GrowthSettings settings;
  settings.prune_to = ball.get();
  settings.train = true;
  const Camera camera = subject.camera({}, 128);
  Mask mask, expected;
  Plant plant;
  const std::array views{SilhouetteView{&camera, &mask}};
  const auto renderer = make_scanline_renderer();
  grow_and_draw(subject.model, subject.preset.values, 3, settings, *renderer, views, plant);
  subject.model.generate(subject.preset.values, 3, settings, plant);
  renderer->draw(plant, camera, expected);
  EXPECT_EQ(mask, expected);
}

TEST(GrowAndDraw, ServesRenderersThatNeedTheWholePlant) {
  const Subject subject("palm");
  const Camera camera = subject.camera({}, 80);
  Mask mask, expected;
  Plant plant;
  const std::array views{SilhouetteView{&camera, &mask}};
  const auto renderer = make_embree_renderer();
  grow_and_draw(subject.model, subject.preset.values, 3, {}, *renderer, views, plant);
  renderer->draw(subject.plant, camera, expected);
  EXPECT_EQ(mask, expected);
}

}  // namespace
}  // namespace espalier
