// Ranges and starts to the measure of a picture.
#include <gtest/gtest.h>

#include <espalier/fitting/picture/crown_reading.h>
#include <espalier/fitting/starts/fit_plan.h>
#include <espalier/fitting/starts/measured_start.h>
#include <espalier/fitting/task/record_task.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>
#include <espalier/weber_penn/tree_crown.h>

#include "support/lsystem_files.h"
#include "support/toy_model.h"

namespace espalier {
namespace {

FitRecord record_of(const std::string& target, KindChoice kind = KindChoice::automatic) {
  FitRecord record;
  record.views = {{std::filesystem::path(ESPALIER_SOURCE_DIR) / "targets" / (target + ".png"), {}}};
  record.target.size_px = 64;
  record.growth = {600, 6'000};
  record.kind = kind;
  return record;
}

/// Of a leafy Weber–Penn tree, 10 m tall.
std::map<std::string, SearchRange> ranges_of(const PictureReading& reading) {
  return measured_ranges(model_by_name("weber_penn").table(), reading, TreeKind::leafy, 10);
}

class MeasuredStart : public testing::TestWithParam<const char*> {};

TEST_P(MeasuredStart, EveryStartIsInTheRangesAndValid) {
  FitRecord record = record_of(GetParam());
  const FitTask task = make_task(record);
  const FitPlan plan = plan_of(record, task);
  ASSERT_FALSE(plan.choice.ranges.empty());
  const ParameterTable& table = task.model->table();
  for (const StartPoint& start : plan.starts)
    for (const auto& [name, range] : plan.choice.ranges) {
      const double value = start.values[table.index_of(name)];
      if (plan.choice.fixed.contains(name)) continue;
      EXPECT_GE(value, range.lower) << start.name << " " << name;
      EXPECT_LE(value, range.upper) << start.name << " " << name;
    }
}

TEST_P(MeasuredStart, TheSearchStaysInTheRanges) {
  FitRecord record = record_of(GetParam());
  record.start = "palm";
  const FitTask task = make_task(record);
  const FitPlan plan = plan_of(record, task);
  const SearchSpace space = make_search_space(task.model->table(), plan.starts.front().values, plan.choice);
  for (const FreeParameter& free : space.free)
    if (const auto range = plan.choice.ranges.find(free.name); range != plan.choice.ranges.end()) {
      EXPECT_GE(value_at(free, 0), range->second.lower) << free.name;
      EXPECT_LE(value_at(free, 1), range->second.upper) << free.name;
    }
}

INSTANTIATE_TEST_SUITE_P(Targets, MeasuredStart,
                         testing::Values("tr_fir", "oc_orange", "oc_palm", "tr_crookedtree4", "tr_birch"),
                         [](const auto& info) { return std::string(info.param); });

TEST(MeasuredStart, AnyKindIsLeftAsItIs) {
  FitRecord record = record_of("tr_fir", KindChoice::any);
  EXPECT_TRUE(plan_of(record, make_task(record)).choice.ranges.empty());
}

TEST(MeasuredStart, WhatTheUserFreesHeSearchesInFull) {
  FitRecord record = record_of("tr_fir");
  record.search.free = {"ratio", "length[1]"};
  EXPECT_TRUE(plan_of(record, make_task(record)).choice.ranges.empty());
}

TEST(MeasuredStart, AThickTrunkHasThinBranches) {
  const PictureReading thick{.trunk_width = 0.3, .crown_base = 0.3, .crown_width = 0.8},
      thin{.trunk_width = 0.03, .crown_base = 0.3, .crown_width = 0.8};
  const auto of_thick = ranges_of(thick);
  const auto of_thin = ranges_of(thin);
  EXPECT_GT(of_thick.at("ratio").lower, of_thin.at("ratio").upper);
  EXPECT_LT(of_thick.at("radius_mod[1]").upper, of_thin.at("radius_mod[1]").upper);
}

TEST(MeasuredStart, LeavesAreAsLargeAsThoseOfSpecies) {
  const ParameterTable& table = model_by_name("weber_penn").table();
  const auto of_species = ranges_of({});
  for (const std::string& name : bundled_presets()) {
    if (name == "palm" || name == "fan_palm") continue;
    const ParameterValues values = load_preset(name).values;
    const auto value = [&](const char* parameter) { return values[table.find(parameter).value()]; };
    EXPECT_LE(value("leaf_scale") / value("g_scale"), of_species.at("leaf_scale").upper / 10 + 1e-12) << name;
    EXPECT_LE(value("leaf_scale_x"), of_species.at("leaf_scale_x").upper) << name;
  }
  const auto any = measured_ranges(table, {}, TreeKind::leafy, 10, LeafSizes::any);
  EXPECT_GT(any.at("leaf_scale").upper, of_species.at("leaf_scale").upper);
  EXPECT_FALSE(any.contains("leaf_scale_x"));
}

TEST(MeasuredStart, WhatIsAsWideAsTheCrownIsNoTrunk) {
  const PictureReading crown{.trunk_width = 0.5, .crown_base = 1, .crown_width = 0.6};
  EXPECT_LE(ranges_of(crown).at("ratio").upper, 0.03);
}

TEST(MeasuredStart, ATrunkFlaresNoMoreThanItsFoot) {
  PictureReading straight{.trunk_width = 0.06, .foot_width = 0.06, .crown_base = 0.3, .crown_width = 0.8},
      flared = straight;
  flared.foot_width = 0.12;
  EXPECT_LE(ranges_of(straight).at("flare").upper, 0.1);
  EXPECT_NEAR(ranges_of(flared).at("flare").upper, 1, 1e-9);
}

TEST(MeasuredStart, AStartTakesTheWidthOfTheCrown) {
  FitRecord record = record_of("oc_cypress");  // a narrow crown
  const FitTask task = make_task(record);
  const PictureReading reading = read_picture(task.views[0].target.mask());
  ASSERT_LT(reading.crown_width, 0.5);
  for (const StartPoint& start : plan_of(record, task).starts) {
    if (start.name != "quaking_aspen") continue;
    Plant plant;
    task.model->generate(start.values, 1, {record.growth, nullptr}, plant);
    const Bounds box = bounds(plant);
    EXPECT_LT((box.upper.x - box.lower.x) / (box.upper.z - box.lower.z), 1.5 * reading.crown_width);
  }
}

/// The envelope that the first start of a fit has: of a tree that is 10 m tall.
CrownEnvelope first_crown(FitRecord record) {
  const FitTask task = make_task(record);
  const ParameterValues values = plan_of(record, task).starts.front().values;
  const auto scale_m = static_cast<float>(values[task.model->table().index_of("g_scale")]);
  return CrownEnvelope(crown_shape(weber_penn_parameters(values), scale_m));
}

TEST(MeasuredStart, ACrownThatTheUserWantsBeginsAsThePictures) {
  FitRecord record = record_of("oc_orange");
  record.search.fixed = {{"crown_use", 2}, {"crown_rim_left", 0.125}};
  for (const char* start : {"auto", "quaking_aspen"}) {
    record.start = start;
    const FitTask task = make_task(record);
    const double height_m = target_height_m(record);
    const CrownShape seen =
        crown_shape_of(read_crown(task.views[0].target.mask(), task.views[0].reading), height_m);
    const CrownShape got = first_crown(record).shape();
    const double slack_m = 1e-4 * height_m;
    EXPECT_NEAR(got.top_m.z, seen.top_m.z, slack_m);
    EXPECT_NEAR(got.bottom_m.z, seen.bottom_m.z, slack_m);
    for (std::size_t side = 0; side < 4; ++side)
      EXPECT_NEAR(got.radius_m[side], seen.radius_m[side], slack_m);
    EXPECT_NEAR(got.rim_m[0], seen.rim_m[0], slack_m);
    EXPECT_NEAR(got.shape_above, seen.shape_above, 1e-4);
    EXPECT_NEAR(got.shape_below, seen.shape_below, 1e-4);
    EXPECT_NEAR(got.rim_m[2], std::lerp(seen.bottom_m.z, seen.top_m.z, 0.125f), slack_m);  // the user's
  }
}

TEST(MeasuredStart, ACrownThatIsNotSeenOrNotWantedStaysTheStarts) {
  const auto has_crown_of_table = [](FitRecord record) {
    const FitTask task = make_task(record);
    const ParameterTable& table = task.model->table();
    const ParameterValues values = plan_of(record, task).starts.front().values;
    return values[table.index_of("crown_radius_left")] ==
           table.defaults()[table.index_of("crown_radius_left")];
  };
  FitRecord record = record_of("oc_orange");
  record.start = "quaking_aspen";
  EXPECT_TRUE(has_crown_of_table(record));  // not in use
  record.search.fixed = {{"crown_use", 2}};
  EXPECT_FALSE(has_crown_of_table(record));
  record.kind = KindChoice::any;  // the picture says nothing
  EXPECT_TRUE(has_crown_of_table(record));
  record.kind = KindChoice::automatic;
  record.views.front().view.azimuth_deg = 90;
  EXPECT_TRUE(has_crown_of_table(record));
}

TEST(MeasuredStart, AStartWithACrownOfItsOwnKeepsIt) {
  FitRecord record = record_of("oc_orange");
  record.start = "bonsai_chokkan";
  const ParameterTable& table = model_by_name("weber_penn").table();
  const ParameterValues own = load_preset(record.start).values;
  ASSERT_NE(own[table.index_of("crown_use")], 0);
  record.search.fixed = {{"crown_use", 1}};
  const FitTask task = make_task(record);
  const ParameterValues values = plan_of(record, task).starts.front().values;
  for (const char* row : {"crown_radius_left", "crown_top", "crown_shape_above"})
    EXPECT_EQ(values[table.index_of(row)], own[table.index_of(row)]) << row;
}

TEST(MeasuredStart, ACrownDownToTheGroundMayBeginThere) {
  PictureReading reading{.trunk_width = 0.4, .foot_width = 0.5, .crown_base = 0.6, .crown_width = 0.7};
  EXPECT_EQ(ranges_of(reading).at("base_size[0]").lower, 0);
}

TEST(MeasuredStart, AMoundUnderTheTrunkMayBeFilledByTheTree) {
  PictureReading reading{.trunk_width = 0.1, .foot_width = 0.2, .crown_base = 0.4, .crown_width = 0.7};
  EXPECT_GT(ranges_of(reading).at("base_size[0]").lower, 0);
  reading.stand_height = 0.1;
  EXPECT_EQ(ranges_of(reading).at("base_size[0]").lower, 0);
}

constexpr PictureReading kSeen{
    .trunk_width = 0.06, .foot_width = 0.08, .crown_base = 0.3, .crown_width = 0.8};

TEST(MeasuredStart, RangesAreTheSameUnderOtherNames) {
  const ToyModel toy;
  for (const TreeKind kind : {TreeKind::leafy, TreeKind::leafless, TreeKind::palm}) {
    const auto ranges = measured_ranges(ToyModel::original().table(), kSeen, kind, 10);
    const auto toy_ranges = measured_ranges(toy.table(), kSeen, kind, 10);
    EXPECT_FALSE(ranges.empty());
    EXPECT_EQ(toy_ranges.size(), ranges.size());
    for (const auto& [name, range] : ranges) {
      const SearchRange& other = toy_ranges.at(toy.name_of(name));
      EXPECT_EQ(other.lower, range.lower) << name;
      EXPECT_EQ(other.upper, range.upper) << name;
    }
  }
}

TEST(MeasuredStart, StartsAreTheSameUnderOtherNames) {
  const ToyModel toy;
  const ParameterValues before = load_preset("small_pine").values;
  ParameterValues values = before, toy_values = ToyModel::translated(before);
  take_measures(ToyModel::original(), {}, kSeen, 10, 1, values);
  take_measures(toy, {}, kSeen, 10, 1, toy_values);
  EXPECT_NE(values, before);
  EXPECT_EQ(ToyModel::translated(toy_values), values);
}

TEST(MeasuredStart, WhatBearsNoRolesIsLeftAsItIs) {
  const ToyWithoutRoles toy;
  ParameterValues values = toy.table().defaults();
  take_measures(toy, {}, kSeen, 10, 1, values);
  EXPECT_EQ(values, toy.table().defaults());
  EXPECT_TRUE(measured_ranges(toy.table(), kSeen, TreeKind::leafy, 10).empty());
}

TEST(MeasuredStart, ARangeThatNoValidValueLiesInIsNone) {
  ParameterTable table = ToyModel::original().table();
  table.rows[*table.find(Role::leaf_count)].upper = 5;
  EXPECT_FALSE(measured_ranges(table, kSeen, TreeKind::leafy, 10).contains("leaf_blos_num"));
}

TEST(MeasuredStart, AnLsystemThatDeclaresRolesIsMeasured) {
  const Model& model = lsystem_model_of("measured.lsys", R"(unit: 0.5
param thick = 0.1 in 0.01 .. 9 role trunk_radius
param bare = 0.1 in 0 .. 0.9 role crown_base
param reach = 4 in 0.5 .. 20 role branch_length
axiom: !(2*thick)F(10*bare)[+(90)!(0.1)F(reach)][-(90)!(0.1)F(reach)]F(10 - 10*bare)
)");
  ParameterValues values = model.table().defaults();
  take_measures(model, {}, kSeen, 5, 1, values);
  EXPECT_NEAR(values[0], 0.45 * kSeen.trunk_width * 5 / 0.5, 1e-9) << "units of half a metre";
  EXPECT_EQ(values[1], kSeen.crown_base);
  EXPECT_NE(values[2], 4);
  EXPECT_TRUE(measured_ranges(model.table(), kSeen, TreeKind::leafy, 5).contains("bare"));
}

}  // namespace
}  // namespace espalier
