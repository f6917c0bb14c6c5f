// Palms: their trunk is read off the picture, and the trees of a fit stand on it.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include <espalier/fitting/branches/palm_trunk.h>
#include <espalier/fitting/run/fit.h>
#include <espalier/fitting/starts/fit_plan.h>
#include <espalier/fitting/task/record_task.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>

#include "support/temporary_folders.h"
#include "support/toy_model.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

struct Drawn {
  float foot_x, foot_width, top_width, lean, crown_radius;
};
constexpr int kSize = 128, kFootRow = 120, kCrownRow = 40;

/// The middle of the trunk at a height.
float middle_x(const Drawn& palm, float y) { return palm.foot_x + palm.lean * (kFootRow - y); }

/// A trunk of straight sides below a disc.
Mask drawn(const Drawn& palm) {
  Mask mask(kSize, kSize);
  for (int y = 0; y < kFootRow; ++y)
    for (int x = 0; x < kSize; ++x) {
      const float up = static_cast<float>(kFootRow - y) / (kFootRow - kCrownRow);
      const float half = 0.5f * (palm.foot_width + up * (palm.top_width - palm.foot_width));
      const auto px = static_cast<float>(x) + 0.5f, py = static_cast<float>(y) + 0.5f;
      const bool on_trunk = y > kCrownRow && std::fabs(px - middle_x(palm, py)) < half;
      const bool in_crown = std::hypot(px - middle_x(palm, kCrownRow), py - kCrownRow) < palm.crown_radius;
      if (on_trunk || in_crown) mask.set(x, y);
    }
  return mask;
}

RC_GTEST_PROP(TrunkLine, IsTheLineThatWasDrawn, ()) {
  const auto between = [](int low, int high) { return static_cast<float>(*rc::gen::inRange(low, high + 1)); };
  const float foot = between(5, 12);
  const Drawn palm{between(54, 74), foot, between(4, static_cast<int>(foot)), between(-25, 25) / 100,
                   between(14, 24)};
  const auto line = read_trunk_line(drawn(palm));
  RC_ASSERT(line.has_value());
  RC_ASSERT(line->points.front().y == static_cast<float>(kFootRow));
  for (const PixelPoint& point : line->points) RC_ASSERT(std::fabs(point.x - middle_x(palm, point.y)) < 4.5f);
  RC_ASSERT(std::fabs(line->points.back().y - kCrownRow) < 3.f);
  const float across = 1 / std::cos(std::atan(palm.lean));  // rows cut a leaning trunk at a slant
  RC_ASSERT(std::fabs(line->foot_width_px - palm.foot_width * across) < 3.5f);
  RC_ASSERT(std::fabs(line->top_width_px - palm.top_width * across) < 3.5f);
}

TEST(TrunkLine, WhatHasNoBareTrunkHasNone) {
  Mask disc(64, 64), pole(64, 64);
  for (int y = 8; y < 56; ++y) pole.set(32, y);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      if (std::hypot(x - 32, y - 32) < 20) disc.set(x, y);
  EXPECT_FALSE(read_trunk_line(Mask(64, 64)));
  EXPECT_FALSE(read_trunk_line(disc));
  EXPECT_FALSE(read_trunk_line(pole));  // and no crown
}

FitRecord palm_record(const std::string& picture) {
  FitRecord record;
  record.views = {{fs::path(ESPALIER_SOURCE_DIR) / "targets" / (picture + ".png"), {}}};
  record.kind = KindChoice::automatic;
  record.budget = {30, 0, 0, 2};
  return record;
}

class PalmTrunk : public testing::TestWithParam<const char*> {};

TEST_P(PalmTrunk, StandsOnTheLineOfThePicture) {
  FitRecord record = palm_record(GetParam());
  FitTask task = make_task(record);
  settle_branches(plan_of(record, task), task);
  ASSERT_FALSE(task.overrides.empty());
  const TrunkLine line = *read_trunk_line(task.views[0].target.mask());
  for (const StartPoint& start : plan_of(record, task).starts) {
    Plant plant;
    task.model->generate(start.values, task.plant_seeds.front(), task.growth, plant);
    std::vector<PixelPoint> trunk;
    for (std::size_t knot = 0; knot < plant.stems.first_knot[1]; ++knot) {
      const PicturePoint seen = project(task.views[0].camera, plant.knots.point_m[knot]);
      trunk.push_back({seen.x_px, seen.y_px});
    }
    const auto grown = evenly_spaced(trunk, 9), seen = evenly_spaced(line.points, 9);
    for (std::size_t i = 0; i < seen.size(); ++i)
      EXPECT_LT(std::hypot(grown[i].x - seen[i].x, grown[i].y - seen[i].y), 2.5) << start.name << " " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(OfPictures, PalmTrunk, testing::Values("oc_palm", "tr_palmtree2", "reference_palm"));

TEST(PalmTrunk, IsTheSameUnderOtherNames) {
  const ToyModel toy;
  const TrunkLine line{{{10, 100}, {14, 50}, {12, 20}}, 9, 6};
  const auto fixed = palm_parameters(ToyModel::original().table(), line, 0.1);
  const auto toy_fixed = palm_parameters(toy.table(), line, 0.1);
  EXPECT_EQ(fixed.size(), 37u);  // 16 numbers, and those of three curves of trunks
  EXPECT_EQ(toy_fixed.size(), fixed.size());
  for (const auto& [name, value] : fixed) EXPECT_EQ(toy_fixed.at(toy.name_of(name)), value) << name;
  EXPECT_TRUE(can_hold_trunks(toy));
  EXPECT_FALSE(can_hold_trunks(ToyWithoutRoles()));
}

TEST(PalmTrunk, ModelsNamePresetsOfTheirOwnWithFronds) {
  ASSERT_FALSE(ToyModel::original().palm_presets().empty());
  for (const std::string& name : ToyModel::original().palm_presets())
    EXPECT_EQ(load_preset(name).model, ToyModel::original().table().model);
}

TEST(PalmFit, LeavesATreeOfTrunkAndFronds) {
  const fs::path run = fresh_folder("palm_fit") / "run";
  fit(palm_record("oc_palm"), run);
  const Preset best = load_preset((run / "best.toml").string()),
               other = load_preset((run / "archive" / "1.toml").string());
  const ParameterTable& table = model_by_name(best.model).table();
  EXPECT_EQ(best.values[table.index_of("levels")], 2);
  EXPECT_GT(best.values[table.index_of("leaf_blos_num")], 50);
  EXPECT_NE(best.overrides.find({0}), nullptr);
  EXPECT_NE(other.overrides.find({0}), nullptr);
}

TEST(PalmFit, IsLeftToTheUserWhoFreesOrStarts) {
  FitRecord freed = palm_record("oc_palm"), started = freed;
  freed.search.free = {"g_scale"};
  started.start = "quaking_aspen";
  for (FitRecord record : {freed, started}) {
    FitTask task = make_task(record);
    settle_branches(plan_of(record, task), task);
    EXPECT_TRUE(task.overrides.empty());
  }
}

}  // namespace
}  // namespace espalier
