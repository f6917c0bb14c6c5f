// Ranges and starts to the measure of a picture.
#include <gtest/gtest.h>

#include <espalier/fitting/starts/fit_plan.h>
#include <espalier/fitting/starts/measured_start.h>
#include <espalier/fitting/task/record_task.h>
#include <espalier/models/models.h>

namespace espalier {
namespace {

FitRecord record_of(const std::string& target, KindChoice kind = KindChoice::automatic) {
  FitRecord record;
  record.views = {{std::filesystem::path(ESPALIER_SOURCE_DIR) / "targets" / (target + ".png"), {}}};
  record.target.size_px = 64;
  record.kind = kind;
  return record;
}

class MeasuredStart : public testing::TestWithParam<const char*> {};

TEST_P(MeasuredStart, EveryStartIsInTheRangesAndValid) {
  FitRecord record = record_of(GetParam());
  const FitTask task = make_task(record);
  const SearchChoice choice = plan_of(record, task).choice;
  ASSERT_FALSE(choice.ranges.empty());
  const ParameterTable& table = task.model->table();
  for (const StartPoint& start : plan_of(record, task).starts)
    for (const auto& [name, range] : choice.ranges) {
      const double value = start.values[table.index_of(name)];
      if (choice.fixed.contains(name)) continue;
      EXPECT_GE(value, range.lower) << start.name << " " << name;
      EXPECT_LE(value, range.upper) << start.name << " " << name;
    }
}

TEST_P(MeasuredStart, TheSearchStaysInTheRanges) {
  FitRecord record = record_of(GetParam());
  const FitTask task = make_task(record);
  const SearchChoice choice = plan_of(record, task).choice;
  const SearchSpace space =
      make_search_space(task.model->table(), plan_of(record, task).starts.front().values, choice);
  for (const FreeParameter& free : space.free)
    if (const auto range = choice.ranges.find(free.name); range != choice.ranges.end()) {
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
  const auto of_thick = measured_ranges(thick, TreeKind::leafy, 10);
  const auto of_thin = measured_ranges(thin, TreeKind::leafy, 10);
  EXPECT_GT(of_thick.at("ratio").lower, of_thin.at("ratio").upper);
  EXPECT_LT(of_thick.at("radius_mod[1]").upper, of_thin.at("radius_mod[1]").upper);
}

TEST(MeasuredStart, WhatIsAsWideAsTheCrownIsNoTrunk) {
  const PictureReading crown{.trunk_width = 0.5, .crown_base = 1, .crown_width = 0.6};
  EXPECT_LE(measured_ranges(crown, TreeKind::leafy, 10).at("ratio").upper, 0.03);
}

TEST(MeasuredStart, ATrunkFlaresNoMoreThanItsFoot) {
  PictureReading straight{.trunk_width = 0.06, .foot_width = 0.06, .crown_base = 0.3, .crown_width = 0.8},
      flared = straight;
  flared.foot_width = 0.12;
  EXPECT_LE(measured_ranges(straight, TreeKind::leafy, 10).at("flare").upper, 0.1);
  EXPECT_NEAR(measured_ranges(flared, TreeKind::leafy, 10).at("flare").upper, 1, 1e-9);
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

TEST(MeasuredStart, ACrownDownToTheGroundMayBeginThere) {
  PictureReading reading{.trunk_width = 0.4, .foot_width = 0.5, .crown_base = 0.6, .crown_width = 0.7};
  EXPECT_EQ(measured_ranges(reading, TreeKind::leafy, 10).at("base_size[0]").lower, 0);
}

TEST(MeasuredStart, AMoundUnderTheTrunkMayBeFilledByTheTree) {
  PictureReading reading{.trunk_width = 0.1, .foot_width = 0.2, .crown_base = 0.4, .crown_width = 0.7};
  EXPECT_GT(measured_ranges(reading, TreeKind::leafy, 10).at("base_size[0]").lower, 0);
  reading.stand_height = 0.1;
  EXPECT_EQ(measured_ranges(reading, TreeKind::leafy, 10).at("base_size[0]").lower, 0);
}

}  // namespace
}  // namespace espalier
