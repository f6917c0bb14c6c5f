// Trees traced along the branches of a picture.
#include <gtest/gtest.h>

#include <espalier/fitting/branches/branch_refinement.h>
#include <espalier/fitting/branches/branch_tracing.h>
#include <espalier/fitting/branches/reach_limit.h>
#include <espalier/fitting/task/record_task.h>
#include <espalier/image/masks/morphology.h>
#include <espalier/image/reading/medial_axes.h>
#include <espalier/image/reading/roots.h>
#include <espalier/overrides/change_graph.h>
#include <espalier/overrides/overrides_toml.h>

#include "support/lsystem_files.h"
#include "support/toy_model.h"

namespace espalier {
namespace {

FitTask task_of(const std::string& target, int size_px = 256) {
  FitRecord record;
  record.views = {{std::filesystem::path(ESPALIER_SOURCE_DIR) / "targets" / (target + ".png"), {}}};
  record.target.size_px = size_px;
  return make_task(record);
}

Solution traced(const FitTask& task, Seed seed = 1) {
  Solution start{.values = task.model->table().defaults()};
  start.values[task.model->table().index_of("leaf_blos_num")] = 0;
  start.score = score_of(task, start);
  return trace_branches(task, {.key = root_key(seed)}, start);
}

Plant grown(const FitTask& task, const Solution& solution) {
  const ChangeGraph graph(solution.overrides);
  GrowthSettings growth;
  growth.changes = &graph;
  Plant plant;
  task.model->generate(solution.values, solution.plant_seed, growth, plant);
  return plant;
}

/// Of the plant's knots, the share at most 3 pixels from the picture's wood, or between its roots.
double share_on_wood(const FitTask& task, const Plant& plant) {
  const Mask wood = dilate_disc(without_roots(task.views[0].target.mask()), 3);
  std::size_t near = 0;
  for (const Vec3 point_m : plant.knots.point_m) {
    const PicturePoint seen = project(task.views[0].camera, point_m);
    const auto x = static_cast<int>(std::clamp(seen.x_px, 0.0f, 255.0f));
    const auto y = static_cast<int>(std::clamp(seen.y_px, 0.0f, 255.0f));
    near += wood.get(x, y);
  }
  return static_cast<double>(near) / static_cast<double>(plant.knots.size());
}

class BranchTracing : public testing::TestWithParam<const char*> {};

TEST_P(BranchTracing, GrowsABranchForEachAxisOfThePicture) {
  const FitTask task = task_of(GetParam());
  const Plant plant = grown(task, traced(task));
  const auto axes = medial_axes(without_roots(task.views[0].target.mask()), 0.03f * 256);
  EXPECT_GT(axes.size(), 5u);
  EXPECT_GE(plant.stems.size(), axes.size() * 3 / 4);  // parents may be too thin for the last
  EXPECT_EQ(plant.leaves.size(), 0u);
}

TEST_P(BranchTracing, LaysTheTrunkOnItsAxis) {
  const FitTask task = task_of(GetParam());
  const Plant plant = grown(task, traced(task));
  const MedialAxis trunk = medial_axes(without_roots(task.views[0].target.mask()), 0.03f * 256)[0];
  std::vector<PixelPoint> line;
  for (std::size_t knot = plant.stems.first_knot[0]; knot < plant.stems.first_knot[1]; ++knot) {
    const PicturePoint seen = project(task.views[0].camera, plant.knots.point_m[knot]);
    line.push_back({seen.x_px, seen.y_px});
  }
  const auto on_stem = evenly_spaced(line, 7), on_axis = evenly_spaced(trunk.points, 7);
  double squares = 0;
  for (std::size_t i = 0; i < 7; ++i)
    squares += std::pow(on_stem[i].x - on_axis[i].x, 2) + std::pow(on_stem[i].y - on_axis[i].y, 2);
  EXPECT_LT(std::sqrt(squares / 7), 0.06 * 256);
}

TEST_P(BranchTracing, LaysItsWoodOnThePicturesWood) {
  const FitTask task = task_of(GetParam());
  Solution start{.values = task.model->table().defaults()};
  start.values[task.model->table().index_of("leaf_blos_num")] = 0;
  const Mask& mask = task.views[0].target.mask();
  const double first = share_on_wood(task, grown(task, traced(task)));
  if (!roots_of(mask, box_of(mask))) {
    EXPECT_GT(first, 0.85);
  }
  // On roots one seed may fail: oc_rpg11's first lays a limb across a corner and has .827.
  double on_wood = first / 4;
  for (const Seed seed : {2, 3, 4}) on_wood += share_on_wood(task, grown(task, traced(task, seed))) / 4;
  EXPECT_GT(on_wood, 0.85);
  EXPECT_GT(on_wood, share_on_wood(task, grown(task, start)));
}

TEST_P(BranchTracing, IsAboutAsDeepAsWide) {
  const FitTask task = task_of(GetParam());
  const Plant plant = grown(task, traced(task));
  auto [left_m, right_m] = std::pair(1e9f, -1e9f);
  auto [front_m, back_m] = std::pair(1e9f, -1e9f);
  for (const Vec3 point_m : plant.knots.point_m) {
    left_m = std::min(left_m, point_m.x), right_m = std::max(right_m, point_m.x);
    front_m = std::min(front_m, point_m.y), back_m = std::max(back_m, point_m.y);
  }
  EXPECT_GT((back_m - front_m) / (right_m - left_m), 0.65);
  EXPECT_LT((back_m - front_m) / (right_m - left_m), 1.3);
}

TEST_P(BranchTracing, Repeats) {
  const FitTask task = task_of(GetParam(), 128);
  const Plant first = grown(task, traced(task)), second = grown(task, traced(task));
  ASSERT_EQ(first.knots.size(), second.knots.size());
  for (std::size_t i = 0; i < first.knots.size(); ++i)
    EXPECT_EQ(first.knots.point_m[i].x, second.knots.point_m[i].x);
}

INSTANTIATE_TEST_SUITE_P(Targets, BranchTracing,
                         testing::Values("oc_rpg11", "tr_crookedtree4", "tr_snowytree", "tr_blandbirch"),
                         [](const auto& info) { return std::string(info.param); });

/// Traced from the defaults of the task's model.
Solution traced_from_defaults(const FitTask& task) {
  Solution start{.values = task.model->table().defaults()};
  start.score = score_of(task, start);
  return trace_branches(task, {.key = root_key(1)}, start);
}

/// The toy's original, which has no curves either.
class OriginalWithoutCurves : public Model {
 public:
  OriginalWithoutCurves() : table_(ToyModel::original().table()) { table_.curves.clear(); }
  const ParameterTable& table() const override { return table_; }
  bool has_branch_paths() const override { return true; }
  GrowthEstimate estimate(std::span<const double> values) const override {
    return ToyModel::original().estimate(values);
  }
  GrowthResult generate(std::span<const double> values, Seed seed, const GrowthSettings& settings,
                        Plant& plant) const override {
    return ToyModel::original().generate(values, seed, settings, plant);
  }

 private:
  ParameterTable table_;
};

TEST(BranchTracing, IsTheSameUnderOtherNames) {
  FitTask task = task_of("tr_snowytree", 64);
  const OriginalWithoutCurves without_curves;
  task.model = &without_curves;
  const Solution original = traced_from_defaults(task);
  const ToyModel toy;
  task.model = &toy;
  const Solution other = traced_from_defaults(task);
  EXPECT_FALSE(original.overrides.empty());
  EXPECT_EQ(ToyModel::translated(other.values), original.values);
  EXPECT_EQ(other.score, original.score);
  EXPECT_EQ(overrides_to_toml(other.overrides), overrides_to_toml(original.overrides));
}

TEST(BranchTracing, WhatBearsNoRolesStaysTheStart) {
  FitTask task = task_of("tr_snowytree", 64);
  const ToyWithoutRoles toy;
  task.model = &toy;
  const Solution traced = traced_from_defaults(task);
  EXPECT_TRUE(traced.overrides.empty());
  EXPECT_EQ(traced.values, toy.table().defaults());
}

/// Four branches on a bare pole that sways, in units of half a metre.
std::string swaying_pole(const std::string& height_role) {
  return "unit: 0.5\nparam tall = 4 in 1 .. 99 " + height_role + R"(
param thick = 0.2 in 0.01 .. 9 role trunk_radius
param sway = 20 in 0 .. 40 deg plain 0
axiom: !(2*thick)F(tall/2)+(sway)F(tall/2)[+(50)!(thick)F(tall/4)][-(50)!(thick)F(tall/4)]
)";
}

/// A traced tree would have nothing of the branch.
TEST(BranchTracing, ATreeWithALockedBranchStaysTheStart) {
  const FitTask task = task_of("tr_snowytree");
  Solution start{.values = task.model->table().defaults()};
  start.overrides.set_of(parse_branch_pattern("0/3..7", "test")).is_locked = true;
  const Solution same = trace_branches(task, {.key = root_key(1)}, start);
  EXPECT_EQ(same.values, start.values);
  EXPECT_EQ(overrides_to_toml(same.overrides), overrides_to_toml(start.overrides));
}

TEST(BranchTracing, AnLsystemThatDeclaresRolesIsLaidOnThePicture) {
  FitTask task = task_of("tr_snowytree", 128);
  task.model = &lsystem_model_of("pole.lsys", swaying_pole("role tree_scale"));
  const MedialAxis trunk = medial_axes(without_roots(task.views[0].target.mask()), 0.03f * 128)[0];
  const Solution traced = traced_from_defaults(task);
  EXPECT_NEAR(traced.values[0], trunk.length_px * task.views[0].metres_per_px / 0.5, 1e-4);
  EXPECT_EQ(traced.values[2], 0) << "plain";
  const Plant plant = grown(task, traced), plain = grown(task, {.values = traced.values});
  const auto distance_px = [&](const Plant& of) {
    std::vector<PixelPoint> line;
    for (std::size_t knot = of.stems.first_knot[0]; knot < of.stems.first_knot[1]; ++knot) {
      const PicturePoint seen = project(task.views[0].camera, of.knots.point_m[knot]);
      line.push_back({seen.x_px, seen.y_px});
    }
    const PixelPoint tip = line.back(), wanted = trunk.points.back();
    return std::hypot(tip.x - wanted.x, tip.y - wanted.y);
  };
  EXPECT_LT(distance_px(plant), 0.06 * 128);
  EXPECT_LE(distance_px(plant), distance_px(plain));
}

TEST(BranchTracing, AnLsystemThatDoesNotSayHowLongItsTrunkIsStaysTheStart) {
  FitTask task = task_of("tr_snowytree", 64);
  task.model = &lsystem_model_of("unknown_pole.lsys", swaying_pole(""));
  EXPECT_TRUE(traced_from_defaults(task).overrides.empty());
}

TEST(ReachLimit, AllowsWhatIsAsDeepAsWideAndNothingOutsideOfTheFrame) {
  const FitTask task = task_of("tr_birch", 128);
  const ReachLimit limit(task);
  Plant plant;
  const auto put = [&](Vec3 point_m) { plant.knots.point_m = {point_m}; };
  put({0, 0, 5});
  EXPECT_EQ(limit.excess_m(plant), 0);
  put({0, 2, 5});
  EXPECT_EQ(limit.excess_m(plant), 0);
  put({0, 12, 5});
  EXPECT_GT(limit.excess_m(plant), 5);
  put({0, 0, 20});
  EXPECT_GT(limit.excess_m(plant), 5);
}

}  // namespace
}  // namespace espalier
