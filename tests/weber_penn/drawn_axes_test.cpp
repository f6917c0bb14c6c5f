// Stems that follow drawn axes, and what else overrides say of a stem's own frame: splits and the trunk's
// plane.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include <espalier/models/preset.h>
#include <espalier/overrides/change_graph.h>
#include <espalier/overrides/stem_measures.h>
#include <espalier/overrides/turn.h>
#include <espalier/weber_penn/model.h>
#include <espalier/weber_penn/table/parameters.h>

namespace espalier {
namespace {

using Settings = std::vector<std::pair<const char*, double>>;

/// Straight stems, and nothing at random: what bends them is what a test says.
ParameterValues plain_tree(const Settings& settings = {}) {
  const ParameterTable& table = weber_penn_table();
  ParameterValues values = table.defaults();
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (table.rows[i].plain) values[i] = *table.rows[i].plain;
  const auto set = [&](const char* name, double value) { values[table.index_of(name)] = value; };
  for (const char* name : {"curve_v[0]", "curve_v[1]", "curve_v[2]"}) set(name, 0);
  set("g_scale", 10), set("levels", 3), set("branches[1]", 8), set("branches[2]", 4), set("leaf_blos_num", 0);
  for (const auto& [name, value] : settings) set(name, value);
  return values;
}

Plant grow(const ParameterValues& values, const Overrides& overrides, Seed seed = 1) {
  const ChangeGraph changes(overrides);
  GrowthSettings settings{{50'000, 300'000}};
  settings.changes = &changes;
  Plant plant;
  EXPECT_TRUE(weber_penn_model().generate(values, seed, settings, plant).grown);
  return plant;
}

std::size_t stem_at(const Plant& plant, const BranchPath& path) {
  for (std::size_t stem = 0; stem < plant.stems.size(); ++stem)
    if (path_of(plant, stem) == path) return stem;
  throw std::runtime_error("no stem " + to_string(path));
}

std::vector<Vec3> knots_of(const Plant& plant, const BranchPath& path) {
  const std::size_t stem = stem_at(plant, path);
  return {plant.knots.point_m.begin() + plant.stems.first_knot[stem],
          plant.knots.point_m.begin() + plant.stems.first_knot[stem + 1]};
}

/// From its base.
std::vector<Vec3> form_of(const Plant& plant, const BranchPath& path) {
  std::vector<Vec3> points = knots_of(plant, path);
  const Vec3 base = points[0];
  for (Vec3& point : points) point = point - base;
  return points;
}

float length_of(const Plant& plant, const BranchPath& path) {
  return ArcLengths(plant).of_stem_m(plant.stems, stem_at(plant, path));
}

Overrides drawn(const BranchPath& path, std::vector<AxisPoint> points, AxisFrame frame = AxisFrame::parent) {
  Overrides overrides;
  overrides.at(path).set.axis = DrawnAxis{std::move(points), frame};
  return overrides;
}

void set(Overrides& overrides, const BranchPath& path, Quantity quantity, Relation relation, double number,
         bool is_private = true) {
  set_override(overrides.at(path).set, {quantity, relation, number, is_private});
}

/// A smooth curve that is not flat.
std::vector<AxisPoint> any_axis() {
  const std::size_t count =
      *rc::gen::elementOf(std::vector<std::size_t>(kAxisCounts.begin(), kAxisCounts.end()));
  const auto off = [] { return *rc::gen::inRange(-100, 101) / 100.0; };
  std::vector<AxisPoint> points{{0, 0, 1 / static_cast<double>(count)}};
  while (points.size() < count)
    points.push_back(points.back() + AxisPoint{off(), off(), 1} * (1 / static_cast<double>(count)));
  return points;
}

float farthest(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  if (a.size() != b.size()) return 1e9f;
  float most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, length(a[i] - b[i]));
  return most;
}

float distance_to(const std::vector<Vec3>& points, Vec3 point) {
  float least = 1e9f;
  for (const Vec3 other : points) least = std::min(least, length(other - point));
  return least;
}

constexpr float kRoundingM = 2e-4f;

RC_GTEST_PROP(DrawnAxis, TheStemPassesAlongItsCurve, ()) {
  const std::vector<AxisPoint> points = any_axis();
  const Plant plant = grow(plain_tree(), drawn({0}, points));
  const AxisCurve axis = make_axis(points);
  const double metres = 10 / AxisArcs(axis).length();
  std::vector<Vec3> fine;
  for (int i = 0; i <= 1000; ++i) {
    const AxisPoint at = axis_point(axis, i / 1000.0) * metres;
    fine.push_back({static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)});
  }
  for (const Vec3 point : form_of(plant, {0})) RC_ASSERT(distance_to(fine, point) < 0.03f);  // of 10 m
  const std::vector<Vec3> knots = knots_of(plant, {0});
  const AxisPoint tip = points.back() * metres;
  RC_ASSERT(length(knots.back() - Vec3{static_cast<float>(tip.x), static_cast<float>(tip.y),
                                       static_cast<float>(tip.z)}) < 0.01f);
}

RC_GTEST_PROP(DrawnAxis, TheStemIsAsLongAsWithoutIt, ()) {
  const ParameterValues values = plain_tree();
  const Plant plain = grow(values, {}), plant = grow(values, drawn({0, 3}, any_axis()));
  RC_ASSERT(std::fabs(length_of(plant, {0, 3}) / length_of(plain, {0, 3}) - 1) < 0.01f);
}

RC_GTEST_PROP(DrawnAxis, TheSizeItIsDrawnInDoesNotMatter, ()) {
  std::vector<AxisPoint> points = any_axis();
  const Plant one = grow(plain_tree(), drawn({0, 3}, points));
  for (AxisPoint& point : points) point = point * 7;
  const Plant seven = grow(plain_tree(), drawn({0, 3}, points));
  RC_ASSERT(farthest(knots_of(one, {0, 3}), knots_of(seven, {0, 3})) < kRoundingM);
}

RC_GTEST_PROP(DrawnAxis, MorePointsOfTheSameCurveGrowTheSameStem, ()) {
  const std::vector<AxisPoint> points = any_axis();
  const AxisCurve axis = make_axis(points);
  std::vector<AxisPoint> line;
  for (int i = 0; i <= 60; ++i) line.push_back(axis_point(axis, i / 60.0));
  const std::vector<Vec3> few = knots_of(grow(plain_tree(), drawn({0, 3}, points)), {0, 3});
  for (const std::size_t count : kAxisCounts) {
    if (count < points.size()) continue;
    const Plant plant = grow(plain_tree(), drawn({0, 3}, fit_axis(line, count)));
    RC_ASSERT(farthest(few, knots_of(plant, {0, 3})) < kRoundingM);
  }
}

TEST(DrawnAxis, AStraightOneIsTheStraightStem) {
  const std::vector<AxisPoint> up{{0, 0, 0.3}, {0, 0, 0.6}, {0, 0, 1}};
  Overrides facing;
  set(facing, {0}, Quantity::rotation, Relation::value, 90);
  const Plant plain = grow(plain_tree(), facing);
  for (const BranchPath& path : {BranchPath{0}, BranchPath{0, 3}, BranchPath{0, 3, 1}}) {
    Overrides overrides = drawn(path, up);
    set(overrides, {0}, Quantity::rotation, Relation::value, 90);
    const Plant plant = grow(plain_tree(), overrides);
    EXPECT_LT(length(knots_of(plant, path).front() - knots_of(plain, path).front()), kRoundingM);
    EXPECT_LT(length(knots_of(plant, path).back() - knots_of(plain, path).back()), kRoundingM);
    ASSERT_EQ(plant.stems.size(), plain.stems.size());
    for (std::size_t stem = 0; stem < plain.stems.size(); ++stem) {  // and what it bears
      const BranchPath other = path_of(plain, stem);
      EXPECT_LT(length(knots_of(plant, other).back() - knots_of(plain, other).back()), 1e-3f)
          << to_string(other);
    }
  }
}

/// The parent leans, and the branch stands on another side of it.
RC_GTEST_PROP(DrawnAxis, TurnsWithItsParentInTheParentsFrameAlone, ()) {
  const std::vector<AxisPoint> points = any_axis();
  for (const AxisFrame frame : {AxisFrame::parent, AxisFrame::world}) {
    Overrides upright = drawn({0, 3}, points, frame), turned = upright;
    set(turned, {0}, Quantity::down_angle, Relation::offset, 40);
    set(turned, {0}, Quantity::rotation, Relation::value, 0);
    set(upright, {0}, Quantity::rotation, Relation::value, 0);
    std::vector<Vec3> form = form_of(grow(plain_tree(), upright), {0, 3});
    const std::vector<Vec3> after = form_of(grow(plain_tree(), turned), {0, 3});
    if (frame == AxisFrame::parent)  // the trunk leans to the right: about the y axis
      for (Vec3& point : form) point = turn_about({0, 1, 0}, 40)(point);
    RC_ASSERT(farthest(form, after) < 1e-3f);
  }
}

TEST(DrawnAxis, TurnsWithTheAnglesOfItsBranchInTheParentsFrameAlone) {
  const std::vector<AxisPoint> points{{0, 0, 0.3}, {0.2, 0.3, 0.6}, {0, 0, 1}};
  for (const AxisFrame frame : {AxisFrame::parent, AxisFrame::world}) {
    Overrides turned = drawn({0, 3}, points, frame);
    const std::vector<Vec3> form = form_of(grow(plain_tree(), turned), {0, 3});
    set(turned, {0, 3}, Quantity::down_angle, Relation::offset, 30);
    const float moved_m = length(form_of(grow(plain_tree(), turned), {0, 3}).back() - form.back());
    const float expected_m = 2 * 0.258819f * length(form.back());
    EXPECT_NEAR(moved_m, frame == AxisFrame::parent ? expected_m : 0, 1e-3);
  }
}

/// Which way is right does not depend on the seed: a drawn trunk is drawn as the front view sees it.
TEST(DrawnAxis, OfATrunkStandsAsItIsDrawnForAllSeeds) {
  const std::vector<AxisPoint> points{{0, 0, 0.3}, {0.5, 0.1, 0.6}, {0.2, 0.3, 0.9}};
  for (const Seed seed : {1, 2, 3}) {
    const Vec3 tip = knots_of(grow(plain_tree(), drawn({0}, points), seed), {0}).back();
    EXPECT_NEAR(tip.x / tip.z, 0.2 / 0.9, 1e-3);
    EXPECT_NEAR(tip.y / tip.z, 0.3 / 0.9, 1e-3);
  }
}

RC_GTEST_PROP(DrawnAxis, ItsChildrenLeaveItAtTheirAngle, ()) {
  const Plant plant = grow(plain_tree({{"down_angle[2]", 35}}), drawn({0, 3}, any_axis()));
  const ArcLengths arcs(plant);
  const std::size_t parent = stem_at(plant, {0, 3});
  std::size_t seen = 0;
  for (std::size_t stem = 0; stem < plant.stems.size(); ++stem) {
    if (plant.stems.parent[stem] != static_cast<std::int32_t>(parent)) continue;
    const Vec3 base = point_at(plant.stems, plant.knots, stem, {}),
               first = direction_at(plant.stems, plant.knots, stem, {});
    float closest = 1e9f, angle = 0;
    for (int i = 0; i <= 400; ++i) {
      const StemPlace place = arcs.place_at(plant.stems, parent, static_cast<float>(i) / 400);
      const float off = length(point_at(plant.stems, plant.knots, parent, place) - base);
      if (off >= closest) continue;
      closest = off;
      angle =
          std::acos(std::clamp(dot(first, direction_at(plant.stems, plant.knots, parent, place)), -1.f, 1.f));
    }
    RC_ASSERT(std::fabs(angle * 57.29578f - 35) < 3);
    ++seen;
  }
  RC_ASSERT(seen > 0u);
}

TEST(DrawnAxis, IsInheritedByNoBranch) {
  const std::vector<AxisPoint> points{{0, 0.3, 0.3}, {0, 0.6, 0.3}, {0, 0.9, 0.1}};
  const Plant plain = grow(plain_tree(), {}),
              plant = grow(plain_tree(), drawn({0}, points, AxisFrame::world));
  const std::vector<Vec3> child = form_of(plant, {0, 3});
  EXPECT_NEAR(length(child.back()), length(form_of(plain, {0, 3}).back()), 1e-3) << "still straight";
}

TEST(DrawnAxis, BendsFurtherByTheCurvatureBesideIt) {
  const std::vector<AxisPoint> up{{0, 0, 0.3}, {0, 0, 0.6}, {0, 0, 1}};
  Overrides overrides = drawn({0, 3}, up), bent;
  set(overrides, {0, 3}, Quantity::curvature, Relation::offset, 60);
  set(bent, {0, 3}, Quantity::curvature, Relation::offset, 60);
  const Vec3 with_axis = form_of(grow(plain_tree(), overrides), {0, 3}).back(),
             without = form_of(grow(plain_tree({{"curve_res[1]", 60}}), bent), {0, 3}).back();
  EXPECT_LT(length(with_axis - without), 0.02f * length(without));
}

TEST(DrawnAxis, SplitsLeaveItWhereTheyWouldLeaveTheStem) {
  const ParameterValues values = plain_tree({{"seg_splits[0]", 1}, {"split_angle[0]", 30}});
  const std::vector<AxisPoint> up{{0, 0, 0.3}, {0, 0, 0.6}, {0, 0, 1}};
  const Plant plain = grow(values, {}), plant = grow(values, drawn({0}, up));
  std::size_t splits = 0;
  for (std::size_t stem = 0; stem < plain.stems.size(); ++stem) {
    const BranchPath path = path_of(plain, stem);
    if (path.size() != 2 || path[1] < kFirstSplit) continue;
    ++splits;
    const auto at = static_cast<float>((path[1] - kFirstSplit) / kStemsPerSplit);
    EXPECT_NEAR(knots_of(plant, path).front().z, 10 * at / 6, 1e-3) << to_string(path);
  }
  EXPECT_GT(splits, 0u);
}

/// A base split: two parts of one axis, 10 m long without overrides.
ParameterValues split_trunk() {
  return plain_tree(
      {{"base_splits", 1}, {"base_size[0]", 0.2}, {"split_angle[0]", 20}, {"branches[1]", 0}, {"levels", 1}});
}

BranchPath split_of(const Plant& plant) {
  for (std::size_t stem = 0; stem < plant.stems.size(); ++stem)
    if (const BranchPath path = path_of(plant, stem); path.size() == 2) return path;
  throw std::runtime_error("no split");
}

TEST(Splits, FollowARelativeValueOfTheirStemOnce) {
  for (const Quantity quantity :
       {Quantity::length, Quantity::down_angle, Quantity::curvature, Quantity::radius}) {
    Overrides of_all, of_stem;
    const bool is_factor = quantity == Quantity::length || quantity == Quantity::radius;
    const Relation relation = is_factor ? Relation::factor : Relation::offset;
    set(of_all, {0}, quantity, relation, is_factor ? 1.5 : 20, false);
    set(of_stem, {0}, quantity, relation, is_factor ? 1.5 : 20, true);
    const Plant all = grow(split_trunk(), of_all), stem = grow(split_trunk(), of_stem);
    const BranchPath path = split_of(all);
    EXPECT_LT(farthest(knots_of(all, path), knots_of(stem, path)), kRoundingM) << quantity_name(quantity);
    EXPECT_EQ(all.knots.radius_m, stem.knots.radius_m);
  }
}

TEST(Splits, AreAsLongAsTheirStem) {
  Overrides longer;
  set(longer, {0}, Quantity::length, Relation::factor, 1.5, false);
  const Plant plain = grow(split_trunk(), {}), plant = grow(split_trunk(), longer);
  EXPECT_NEAR(length_of(plant, split_of(plant)), 1.5f * length_of(plain, split_of(plain)), 1e-3);
}

TEST(Splits, FollowWhatIsSaidOfThemAlone) {
  const BranchPath path = split_of(grow(split_trunk(), {}));
  Overrides longer;
  set(longer, {0}, Quantity::length, Relation::factor, 1.5, false);
  set(longer, path, Quantity::length, Relation::factor, 2, false);
  const Plant plain = grow(split_trunk(), {}), plant = grow(split_trunk(), longer);
  EXPECT_NEAR(length_of(plant, path), 3 * length_of(plain, path), 1e-3);
}

/// From the right of the front view, counterclockwise seen from above, whatever the seed.
TEST(Trunk, BendsInThePlaneThatItsRotationSays) {
  for (const Seed seed : {1, 2, 3})
    for (const float rotation_deg : {0.f, 90.f, 200.f}) {
      Overrides overrides;
      set(overrides, {0}, Quantity::curvature, Relation::value, 60);
      set(overrides, {0}, Quantity::rotation, Relation::value, rotation_deg);
      const Vec3 tip = knots_of(grow(plain_tree(), overrides, seed), {0}).back();
      EXPECT_NEAR(std::remainder(std::atan2(tip.y, tip.x) * 57.29578f - rotation_deg, 360.f), 0, 0.1);
      EXPECT_GT(std::hypot(tip.x, tip.y), 3);
    }
}

TEST(LeastRadius, IsThatOfTheThinnestBranches) {
  for (const double least_m : {0.0005, 0.005, 0.01}) {
    const ParameterValues values = plain_tree({{"g_scale", 0.6},
                                               {"ratio", 0.06},
                                               {"taper[0]", 0},
                                               {"radius_mod[1]", 0.2},
                                               {"least_radius", 1000 * least_m}});
    const Plant plant = grow(values, {});
    float thinnest_m = 1;
    for (std::size_t stem = 1; stem < plant.stems.size(); ++stem)
      if (plant.stems.level[stem] == 1)
        thinnest_m = std::min(thinnest_m, plant.knots.radius_m[plant.stems.first_knot[stem]]);
    if (least_m < 0.001) {
      EXPECT_LT(thinnest_m, 0.004f);
      EXPECT_GT(thinnest_m, 0.0005f);
    } else {
      EXPECT_NEAR(thinnest_m, least_m, 1e-6);
    }
  }
}

}  // namespace
}  // namespace espalier
