// Start points: as tall as the target, inside the growth budget, as the user fixed them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <espalier/core/error.h>
#include <espalier/fitting/starts/start_points.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>

#include "support/toy_model.h"

namespace espalier {
namespace {

const Model& model() { return model_by_name("weber_penn"); }
const ParameterTable& table() { return model().table(); }

std::vector<StartPoint> starts(const std::string& start, const SearchChoice& choice = {},
                               GrowthBudget budget = {20'000, 100'000}, double height_m = 10) {
  return make_start_points(model(), parse_start(start), choice, budget, height_m, 1);
}

double value(const StartPoint& point, const std::string& name) {
  return point.values[table().index_of(name)];
}

TEST(StartPoints, GrowAsTallAsTheTarget) {
  for (const double height_m : {4.0, 35.0}) {
    const StartPoint point = starts("small_pine", {}, {20'000, 100'000}, height_m).front();
    Plant plant;
    ASSERT_TRUE(model().generate(point.values, 1, {}, plant).grown);
    EXPECT_NEAR(bounds(plant).upper.z, height_m, 0.02 * height_m);
  }
}

TEST(StartPoints, AutoOffersEveryPresetWithAndWithoutLeaves) {
  const auto points = starts("auto");
  std::size_t leafless = 0;
  for (const StartPoint& point : points) leafless += value(point, "leaf_blos_num") == 0;
  EXPECT_GT(points.size(), bundled_presets().size());
  EXPECT_EQ(points.size() - bundled_presets().size(), leafless);
}

TEST(StartPoints, AreValidValues) {
  for (const StartPoint& point : starts("auto"))
    for (std::size_t i = 0; i < point.values.size(); ++i)
      EXPECT_NO_THROW(check_value(table().rows[i], point.values[i], point.name));
}

TEST(StartPoints, AreThinnedToTheGrowthBudget) {
  const GrowthBudget budget{2'000, 5'000};
  for (const StartPoint& point : starts("weeping_willow,quaking_aspen", {}, budget)) {
    const GrowthEstimate estimate = model().estimate(point.values);
    EXPECT_LE(estimate.stems, budget.max_stems) << point.name;
    EXPECT_LE(estimate.leaves, budget.max_leaves) << point.name;
  }
}

TEST(StartPoints, KeepFixedValues) {
  for (const StartPoint& point : starts("palm", {{}, {{"g_scale", 6.0}}}))
    EXPECT_EQ(value(point, "g_scale"), 6);
}

TEST(StartPoints, DoNotVaryInSizeAndMayRelaxCounts) {
  const StartPoint point = starts("quaking_aspen").front();
  EXPECT_EQ(value(point, "g_scale_v"), 0);
  EXPECT_EQ(value(point, "relaxed_counts"), 1);
}

TEST(StartPoints, ScalingMovesMetresOnly) {
  ParameterValues values = table().defaults();
  scale_plant(table(), 2, values);
  EXPECT_EQ(values[table().index_of("g_scale")], 26);
  EXPECT_EQ(values[table().index_of("ratio")], table().defaults()[table().index_of("ratio")]);
}

TEST(StartPoints, AreTheSameUnderOtherNames) {
  const ToyModel toy;
  const GrowthBudget budget{2'000, 5'000};
  ParameterValues values = load_preset("quaking_aspen").values;
  ParameterValues toy_values = ToyModel::translated(values);
  prepare_start(model(), budget, 7, 1, values);
  prepare_start(toy, budget, 7, 1, toy_values);
  EXPECT_EQ(ToyModel::translated(toy_values), values);
  ASSERT_TRUE(has_leaves(toy.table(), toy_values));
  take_leaves(toy.table(), toy_values);
  EXPECT_EQ(ToyModel::translated(toy_values)[table().index_of("leaf_blos_num")], 0);
}

TEST(StartPoints, LeavesThatMayNotBeNoneAreNotTaken) {
  ParameterTable bearing = table();
  bearing.rows[*bearing.find(Role::leaf_count)].lower = 1;
  ParameterValues values = table().defaults();
  EXPECT_FALSE(has_leaves(bearing, values));
  take_leaves(bearing, values);
  EXPECT_EQ(values, table().defaults());
}

TEST(StartPoints, RefuseUnknownPresets) { EXPECT_THROW(starts("quaking_aspn"), InputError); }

}  // namespace
}  // namespace espalier
