// Laws of L-systems as models.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <thread>

#include <espalier/core/error.h>
#include <espalier/environment/volume.h>
#include <espalier/lsystem/files/bundled.h>
#include <espalier/lsystem/files/model.h>
#include <espalier/overrides/change_graph.h>

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

bool same(const Plant& a, const Plant& b) {
  return a.stems.path_key == b.stems.path_key && a.stems.first_knot == b.stems.first_knot &&
         a.stems.parent == b.stems.parent && a.stems.origin == b.stems.origin &&
         a.stems.level == b.stems.level && a.stems.child_index == b.stems.child_index &&
         a.knots.point_m == b.knots.point_m && a.knots.handle_in_m == b.knots.handle_in_m &&
         a.knots.handle_out_m == b.knots.handle_out_m && a.knots.radius_m == b.knots.radius_m &&
         a.knots.color == b.knots.color && a.leaves.position_m == b.leaves.position_m &&
         a.leaves.axis == b.leaves.axis && a.leaves.side == b.leaves.side &&
         a.leaves.length_m == b.leaves.length_m && a.leaves.width_m == b.leaves.width_m &&
         a.leaves.kind == b.leaves.kind && a.leaves.color == b.leaves.color &&
         a.leaves.shade == b.leaves.shade && a.leaf_shape == b.leaf_shape && a.tree_scale_m == b.tree_scale_m;
}

TEST(LsystemModel, OverridesThatChangeNothingLeaveThePlantAsItIs) {
  Overrides overrides;
  set_override(overrides.at({0}).set, {Quantity::curvature, Relation::offset, 0, false});
  const ChangeGraph changes(overrides);
  for (const std::string& name : bundled_names()) {
    if (name == "knot_garden") continue;  // large; knot_plant is a piece of it
    const auto model = make_model(name);
    GrowthSettings settings;
    settings.changes = &changes;
    Plant plant;
    EXPECT_TRUE(model->generate(model->table().defaults(), 2, settings, plant).grown) << name;
    EXPECT_TRUE(same(plant, grown(*model, model->table().defaults(), 2))) << name;
  }
}

/// A model keeps what it grew last: nobody may see it.
RC_GTEST_PROP(LsystemModel, GrowsTheSameWhateverItGrewBefore, ()) {
  static const auto kept = make_model("topiary_6");
  static const VolumePtr ball = parse_volume("ball(0,0,0.6, 0.5)"), box = parse_volume("box:0,0,0,3,3,1");
  const auto request = [&](const Model& model, int i, Plant& plant) {
    ParameterValues values = model.table().defaults();
    if (i & 1) values.front() *= 1.1;
    Overrides overrides;
    const auto quantity = i & 2 ? Quantity::length : Quantity::radius;
    if (i & 4) set_override(overrides.at({0, 1}).set, {quantity, Relation::factor, 1.5, true});
    const ChangeGraph changes(overrides);
    const PlantPart part{{0, 1}, (i & 8) != 0};
    GrowthSettings settings;
    settings.changes = &changes;
    if (i & 16) settings.only_part = &part;
    if (i & 32) settings.prune_to = i & 64 ? ball.get() : box.get();
    return model.generate(values, i & 128 ? 1 : 2, settings, plant);
  };
  const int i = *rc::gen::inRange(0, 256);
  Plant after_others, alone;
  const GrowthResult one = request(*kept, i, after_others), two = request(*make_model("topiary_6"), i, alone);
  RC_ASSERT(one.grown == two.grown);
  RC_ASSERT(same(after_others, alone));
}

TEST(LsystemModel, ThreadsThatReshapeGetTheirOwnPlants) {
  const auto model = make_model("acer");
  const ParameterValues values = model->table().defaults();
  const auto part_of_seed = [&](Seed seed) {
    GrowthSettings settings;
    const PlantPart part{{0, 1}, false};
    settings.only_part = &part;
    Plant plant;
    model->generate(values, seed, settings, plant);
    return plant;
  };
  const Plant expected[] = {part_of_seed(1), part_of_seed(2)};
  bool right[] = {true, true};
  const auto work = [&](std::size_t of) {
    for (int i = 0; i < 50; ++i) right[of] = right[of] && same(part_of_seed(1 + of), expected[of]);
  };
  std::thread other(work, 1);
  work(0);
  other.join();
  EXPECT_TRUE(right[0] && right[1]);
}

TEST(LsystemModel, CannotChangeWhatComesBeforeGrowing) {
  const auto model = make_model("acer");
  EXPECT_TRUE(model->has_branch_paths());
  EXPECT_FALSE(model->can_train());
  EXPECT_FALSE(model->can_change(Quantity::seed));
  EXPECT_TRUE(model->can_change(Quantity::child_count));
}

}  // namespace
}  // namespace espalier::lsystem
