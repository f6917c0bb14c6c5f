// Branches laid on lines of a picture: where they lie, how deep they go, and how little is asked of the
// model.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include <espalier/fitting/branches/branch_laying.h>
#include <espalier/fitting/task/record_task.h>
#include <espalier/overrides/change_graph.h>

namespace espalier {
namespace {

const FitTask& picture_task() {
  static const FitTask kTask = [] {
    FitRecord record;
    record.views = {{std::filesystem::path(ESPALIER_SOURCE_DIR) / "targets" / "tr_snowytree.png", {}}};
    record.target.size_px = 256;
    return make_task(record);
  }();
  return kTask;
}

/// A plain tree of the picture's height, whose trunk bears four branches.
Solution plain_tree(const FitTask& task) {
  const ParameterTable& table = task.model->table();
  Solution tree{.values = table.defaults()};
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (table.rows[i].plain) tree.values[i] = *table.rows[i].plain;
  tree.values[table.index_of("g_scale")] = 200 * task.views[0].metres_per_px;
  tree.values[table.index_of("leaf_blos_num")] = 0;
  set_override(tree.overrides.at({0}).set, {Quantity::child_count, Relation::value, 4, true});
  return tree;
}

std::vector<Vec3> grown(const FitTask& task, const Solution& tree, const BranchPath& path) {
  const ChangeGraph graph(tree.overrides);
  const PlantPart part{path, true};
  GrowthSettings growth;
  growth.changes = &graph;
  growth.only_part = &part;
  Plant plant;
  task.model->generate(tree.values, tree.plant_seed, growth, plant);
  return plant.knots.point_m;
}

/// An arc of about a third of a circle from a place on the way up from the foot.
LineInPicture any_line(PicturePoint foot) {
  const auto number = [](int low, int high) { return static_cast<float>(*rc::gen::inRange(low, high + 1)); };
  const float up_px = number(40, 120), radius_px = number(15, 50), side = *rc::gen::element(-1.f, 1.f);
  LineInPicture line;
  const double outward_px = number(-7, 7) / 10. * 2 * radius_px * std::sin(1.0);
  for (int i = 0; i <= 20; ++i) {
    const float angle = 2 * static_cast<float>(i) / 20;
    line.widths_px.push_back(4);
    line.deeper_px.push_back(outward_px * i / 20);
    line.points.push_back({foot.x_px + side * radius_px * std::sin(angle),
                           foot.y_px - up_px - radius_px * (1 - std::cos(angle))});
  }
  return line;
}

RC_GTEST_PROP(BranchLaying, PutsTheBranchOnItsLine, ()) {
  const FitTask& task = picture_task();
  const Camera& camera = task.views[0].camera;
  Solution tree = plain_tree(task);
  BranchLayer layer(task);
  const PicturePoint foot = project(camera, {});
  const LineInPicture trunk{{{foot.x_px, foot.y_px}, {foot.x_px, foot.y_px - 200}}, {6, 6}, {}};
  write_offsets(layer.lay(trunk, {0}, tree).offsets, tree.overrides);
  const LineInPicture line = any_line(foot);
  const long before = layer.evaluations();
  write_offsets(layer.lay(line, {0, 1}, tree).offsets, tree.overrides);
  RC_ASSERT(layer.evaluations() - before <= 35);  // a twentieth of 700

  const std::vector<Vec3> knots = grown(task, tree, {0, 1});
  RC_ASSERT(knots.size() > 2u);
  const std::vector<PixelPoint> fine = evenly_spaced(line.points, 400);
  for (const Vec3 knot : knots) {
    const PicturePoint seen = project(camera, knot);
    float off_px = 1e9f;
    for (const PixelPoint& point : fine)
      off_px = std::min(off_px, std::hypot(seen.x_px - point.x, seen.y_px - point.y));
    RC_ASSERT(off_px < 3.5f);  // the base stands on the trunk's surface
  }
  const PicturePoint tip = project(camera, knots.back());
  RC_ASSERT(std::hypot(tip.x_px - line.points.back().x, tip.y_px - line.points.back().y) < 2);
  const double metres_per_px = task.views[0].metres_per_px;
  const double chord_m = metres_per_px * std::hypot(line.points.back().x - line.points.front().x,
                                                    line.points.back().y - line.points.front().y);
  const double deeper_m = metres_per_px * line.deeper_px.back();
  RC_ASSERT(std::fabs(tip.depth_m - project(camera, {}).depth_m - deeper_m) < 0.1 * chord_m);
}

TEST(BranchLaying, StraightLinesGetFewPointsAndCrookedOnesMore) {
  const FitTask& task = picture_task();
  const Solution tree = plain_tree(task);
  const PicturePoint foot = project(task.views[0].camera, {});
  LineInPicture straight, crooked;
  for (int i = 0; i <= 40; ++i) {
    const float up = 5 * static_cast<float>(i);
    straight.points.push_back({foot.x_px, foot.y_px - up});
    crooked.points.push_back({foot.x_px + 12 * std::sin(up / 20), foot.y_px - up});
  }
  BranchLayer layer(task);
  EXPECT_EQ(layer.lay(straight, {0}, tree).offsets.axis->points.size(), 3u);
  EXPECT_EQ(layer.lay(crooked, {0}, tree).offsets.axis->points.size(), 10u);
}

TEST(BranchLaying, GivesABranchTheMeanRadiusOfItsLine) {
  const FitTask& task = picture_task();
  const PicturePoint foot = project(task.views[0].camera, {});
  const LineInPicture trunk{{{foot.x_px, foot.y_px}, {foot.x_px, foot.y_px - 200}}, {12, 4}, {}};
  const LaidBranch laid = BranchLayer(task).lay(trunk, {0}, plain_tree(task));
  double off_m = 0;
  for (std::size_t i = 0; i < laid.wanted_radius_m.size(); ++i)
    off_m += laid.grown_radius_m[i] * (laid.wanted_radius_m[i] - laid.grown_radius_m[i]);
  ASSERT_EQ(laid.grown_radius_m.size(), laid.wanted_radius_m.size());
  EXPECT_NEAR(laid.wanted_radius_m.front(), 6 * task.views[0].metres_per_px, 1e-4);
  EXPECT_NEAR(laid.wanted_radius_m.back(), 2 * task.views[0].metres_per_px, 1e-4);
  EXPECT_NEAR(off_m, 0, 1e-6) << "least squares";
}

TEST(BranchLaying, ABranchThatDoesNotGrowIsLeftAsItIs) {
  const FitTask& task = picture_task();
  BranchLayer layer(task);
  const BranchOffsets branch =
      layer.lay({{{10, 10}, {50, 50}}, {4, 4}, {}}, {0, 77}, plain_tree(task)).offsets;
  EXPECT_FALSE(branch.axis);
  EXPECT_EQ(count_numbers(branch), 0u);
}

}  // namespace
}  // namespace espalier
