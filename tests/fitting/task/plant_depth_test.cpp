// Laws of a plant's depth and of its price.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include <espalier/fitting/task/plant_depth.h>
#include <espalier/fitting/task/plant_scorer.h>
#include <espalier/fitting/task/record_task.h>
#include <espalier/models/grow_preset.h>
#include <espalier/models/preset.h>

namespace espalier {
namespace {

namespace fs = std::filesystem;

Camera camera_from(float azimuth_deg) {
  return frame_base({}, {.azimuth_deg = azimuth_deg}, 0.1f, 64, 64, 60);
}

/// A box of knots.
Plant box_plant(float width_m, float depth_m) {
  Plant plant;
  for (const float x : {0.0f, width_m})
    for (const float y : {0.0f, depth_m}) plant.knots.point_m.push_back({x, y, 1});
  return plant;
}

RC_GTEST_PROP(PlantDepth, FromTheSideIsTheInverse, ()) {
  const float width = 0.1f * static_cast<float>(*rc::gen::inRange(1, 100)),
              depth = 0.1f * static_cast<float>(*rc::gen::inRange(1, 100));
  const Plant plant = box_plant(width, depth);
  const double front = depth_over_width(plant, camera_from(0)),
               side = depth_over_width(plant, camera_from(90));
  RC_ASSERT(std::fabs(front - double(depth) / double(width)) < 1e-5 * front);
  RC_ASSERT(std::fabs(front * side - 1) < 1e-5);
}

TEST(PlantDepth, WithoutWidthOrDepthIsOne) {
  EXPECT_EQ(depth_over_width(box_plant(1, 0), camera_from(0)), 1);
  EXPECT_EQ(depth_over_width(box_plant(0, 1), camera_from(0)), 1);
  EXPECT_EQ(depth_over_width({}, camera_from(0)), 1);
}

RC_GTEST_PROP(PlantDepth, ExcessIsThatOfTheInverseAndGrowsByLogarithms, ()) {
  const double depth = 0.01 * *rc::gen::inRange(1, 1000);
  RC_ASSERT(std::fabs(depth_excess(depth) - depth_excess(1 / depth)) < 1e-12);
  if (depth > 1.2) RC_ASSERT(std::fabs(depth_excess(2 * depth) - depth_excess(depth) - std::log(2)) < 1e-12);
}

TEST(PlantDepth, MostTreesOfSpeciesHaveNoExcess) {
  int usual = 0, all = 0;
  for (const std::string name : {"quaking_aspen", "black_tupelo", "small_pine", "lombardy_poplar", "apple"})
    for (const Seed seed : {1, 2, 3, 4}) {
      const Plant plant = grow_preset(load_preset(name), name, {.seed = seed});
      usual += depth_excess(depth_over_width(plant, camera_from(0))) == 0;
      ++all;
    }
  EXPECT_GE(usual, 0.8 * all);
}

FitTask depth_task(KindChoice kind, double price, bool second_view = false) {
  FitRecord record;
  const fs::path targets = fs::path(ESPALIER_SOURCE_DIR) / "targets";
  record.views = {{targets / "reference_apple.png", {}}};
  if (second_view) record.views.push_back({targets / "reference_apple.png", {.azimuth_deg = 90}});
  record.target.size_px = 64;
  record.kind = kind;
  record.depth_price = price;
  return make_task(record);
}

TEST(PlantDepth, CostsItsPriceTimesTheExcess) {
  const FitTask task = depth_task(KindChoice::leafy, 0.3), free = depth_task(KindChoice::leafy, 0);
  ParameterValues values = load_preset("apple").values;
  for (const auto& [name, value] : {std::pair("levels", 2), {"branches[1]", 4}})  // some seed is deep or flat
    values[task.model->table().find(name).value()] = value;
  double most = 0;
  for (const Seed seed : {1, 2, 3, 4, 5, 6, 7, 8}) {
    FitTask priced = task, plain = free;
    priced.plant_seeds = plain.plant_seeds = {seed};
    double with = 0, without = 0;
    PlantScorer(priced, 1).score({&values, 1}, {&with, 1});
    PlantScorer(plain, 1).score({&values, 1}, {&without, 1});
    Plant plant;
    task.model->generate(values, seed, task.growth, plant);
    const double excess = depth_excess(depth_over_width(plant, task.views[0].camera));
    EXPECT_NEAR(with, std::min(1.0, without + 0.3 * excess), 1e-12) << seed;
    most = std::max(most, excess);
  }
  EXPECT_GT(most, 0) << "the law was tried on nothing";
}

TEST(PlantDepth, CostsNothingWhereOtherViewsShowItOrTheTreeIsBare) {
  EXPECT_EQ(depth_task(KindChoice::leafy, 0.3).depth_price, 0.3);
  EXPECT_EQ(depth_task(KindChoice::leafy, 0.3, true).depth_price, 0);
  EXPECT_EQ(depth_task(KindChoice::leafless, 0.3).depth_price, 0);
}

}  // namespace
}  // namespace espalier
