// Laws of the share of a crown that is wood, and of its price.
#include <gtest/gtest.h>

#include <numbers>

#include <espalier/fitting/task/plant_scorer.h>
#include <espalier/fitting/task/record_task.h>
#include <espalier/fitting/task/wood_share.h>
#include <espalier/models/grow_preset.h>
#include <espalier/models/preset.h>
#include <espalier/plant/leaf_outlines.h>
#include <espalier/render/camera.h>
#include <espalier/render/embree/visible_parts.h>

namespace espalier {
namespace {

namespace fs = std::filesystem;

/// A trunk, and a branch from knot to knot.
Plant branch_of(float length_m, float first_radius_m, float last_radius_m) {
  Plant plant;
  plant.stems.level = {0, 1};
  plant.stems.first_knot = {0, 2, 4};
  plant.knots.point_m = {{0, 0, 0}, {0, 0, 9}, {0, 0, 9}, {length_m, 0, 9}};
  plant.knots.radius_m = {1, 1, first_radius_m, last_radius_m};
  return plant;
}

TEST(WoodShare, OfABranchIsTheAreaOfItsSide) {
  EXPECT_NEAR(branch_area_m2(branch_of(3, 0.2f, 0.2f)), 3 * 0.4, 1e-6);
  EXPECT_NEAR(branch_area_m2(branch_of(3, 0.2f, 0)), 3 * 0.2, 1e-6);
  EXPECT_EQ(branch_area_m2({}), 0);
}

TEST(WoodShare, OfLeavesIsTheAreaOfTheirOutlines) {
  const std::vector<float> lengths{2, 1}, widths{0.5f, 1};
  EXPECT_NEAR(leaf_area_m2(lengths, widths, 9),
              2 * leaf_area_m2({lengths.data() + 1, 1}, {widths.data() + 1, 1}, 9), 1e-9);
  for (int shape = 1; shape <= static_cast<int>(kLeafShapes.size()); ++shape) {
    EXPECT_GT(leaf_area_m2(lengths, widths, shape), 0.1) << shape;
    EXPECT_LT(leaf_area_m2(lengths, widths, shape), 2 * 2) << shape;
  }
}

TEST(WoodShare, IsAShare) {
  EXPECT_EQ(wood_share(0, 0), 0);
  EXPECT_EQ(wood_share(1, 0), 1);
  EXPECT_EQ(wood_share(1, 3), 0.25);
  EXPECT_EQ(wood_excess(wood_share(1, 1)) - wood_excess(wood_share(2, 3)), 0.5 - 0.4);
  EXPECT_EQ(wood_excess(0.05), 0);
}

double leaf_area_of(const Plant& plant) {
  return leaf_area_m2(plant.leaves.length_m, plant.leaves.width_m, plant.leaf_shape);
}

TEST(WoodShare, IsWhatIsSeenOfTheWoodOfCrowns) {
  for (const std::string name :
       {"apple", "balsam_fir", "black_tupelo", "quaking_aspen", "silver_birch", "weeping_willow"}) {
    Plant plant = grow_preset(load_preset(name), name, {});
    const double share = wood_share(branch_area_m2(plant), leaf_area_of(plant));
    const Camera camera = frame_bounds(bounds(plant), {}, 256, 256);
    for (std::size_t stem = 0; stem < plant.stems.size(); ++stem)
      for (std::size_t k = plant.stems.first_knot[stem]; k < plant.stems.first_knot[stem + 1]; ++k)
        if (plant.stems.level[stem] == 0) plant.knots.radius_m[k] = 0;
    const double seen = count_visible_parts(plant, camera).wood_share();
    EXPECT_NEAR(share, seen, 0.07) << name;
  }
}

TEST(WoodShare, CostsItsPriceTimesTheExcess) {
  FitRecord record;
  record.views = {{fs::path(ESPALIER_SOURCE_DIR) / "targets" / "reference_apple.png", {}}};
  record.target.size_px = 64;
  record.kind = KindChoice::leafy;
  record.bare_wood_price = 0.3;
  record.depth_price = 0;
  FitTask task = make_task(record);
  ParameterValues values = load_preset("apple").values;
  values[task.model->table().find("leaf_blos_num").value()] = 2;  // wood before all
  double with = 0;
  PlantScorer(task, 1).score({&values, 1}, {&with, 1});
  Plant plant;
  task.model->generate(values, task.plant_seeds.front(), task.growth, plant);
  Mask mask, leaves;
  task.make_renderer()->draw_apart(plant, task.views[0].camera, mask, leaves);
  const double excess = wood_excess(wood_share(branch_area_m2(plant), leaf_area_of(plant)));
  EXPECT_GT(excess, 0.1);
  EXPECT_NEAR(with, std::min(1.0, score_of_masks(task, {&mask, 1}, {&leaves, 1}) + 0.3 * excess), 1e-9);
}

}  // namespace
}  // namespace espalier
