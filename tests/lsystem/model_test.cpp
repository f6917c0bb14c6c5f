// Laws of L-systems as models.
#include "lsystem/model.h"

#include <gtest/gtest.h>

#include <thread>

#include "core/error.h"

namespace espalier::lsystem {
namespace {

Plant grown(const Model& model, const ParameterValues& values, Seed seed) {
  Plant plant;
  EXPECT_TRUE(model.generate(values, seed, {}, plant).grown);
  return plant;
}

TEST(LsystemModel, ItsTableIsTheParametersAndTheUnit) {
  const auto model = make_model("topiary_6");
  const ParameterTable& table = model->table();
  EXPECT_EQ(table.model, "topiary_6");
  ASSERT_EQ(table.rows.size(), 8u);
  EXPECT_EQ(table.rows[table.index_of("alpha")].unit, "deg");
  EXPECT_EQ(table.rows[table.index_of("alpha")].default_value, 32);
  EXPECT_EQ(table.rows.back().name, "unit");
  EXPECT_THROW(make_model("topiary_66"), InputError);
}

TEST(LsystemModel, SizeGrowsWithTheUnit) {
  const auto model = make_model("acer");
  ParameterValues values = model->table().defaults();
  const Plant one = grown(*model, values, 3);
  values.back() *= 2;
  const Plant two = grown(*model, values, 3);
  ASSERT_EQ(one.knots.size(), two.knots.size());
  for (std::size_t k = 0; k < one.knots.size(); ++k) {
    EXPECT_NEAR(two.knots.point_m[k].z, 2 * one.knots.point_m[k].z, 1e-4f);
    EXPECT_NEAR(two.knots.radius_m[k], 2 * one.knots.radius_m[k], 1e-5f);
  }
}

TEST(LsystemModel, ParametersAndSeedsChangeThePlant) {
  const auto model = make_model("acer");
  ParameterValues values = model->table().defaults();
  const Plant plant = grown(*model, values, 1);
  EXPECT_EQ(grown(*model, values, 1).knots.radius_m, plant.knots.radius_m);
  EXPECT_NE(grown(*model, values, 2).knots.radius_m, plant.knots.radius_m);
  values[model->table().index_of("shorter")] = 0.7;
  EXPECT_NE(grown(*model, values, 1).knots.size(), plant.knots.size());
}

TEST(LsystemModel, ThreadsGrowTheSamePlants) {
  const auto model = make_model("palm");
  const ParameterValues values = model->table().defaults();
  Plant here = grown(*model, values, 4), there;
  std::thread([&] { there = grown(*model, values, 4); }).join();
  ASSERT_EQ(here.knots.size(), there.knots.size());
  for (std::size_t k = 0; k < here.knots.size(); ++k)
    EXPECT_TRUE(here.knots.point_m[k] == there.knots.point_m[k]);
}

TEST(LsystemModel, PlantsBeyondTheBudgetAreRefusedNotThrown) {
  const auto model = make_model("fern");
  GrowthSettings settings;
  settings.budget.max_stems = 10;
  settings.budget.max_leaves = 100;
  Plant plant;
  const GrowthResult result = model->generate(model->table().defaults(), 1, settings, plant);
  EXPECT_FALSE(result.grown);
  EXPECT_GT(result.over_budget_factor, 1);
}

}  // namespace
}  // namespace espalier::lsystem
