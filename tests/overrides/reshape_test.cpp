// Laws of shapes that a grown plant gets by overrides of its branches.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>

#include <espalier/core/error.h>
#include <espalier/overrides/reshape.h>

#include "support/jointed_plants.h"

namespace espalier {
namespace {

constexpr float kRounding = 3e-5f;  ///< of plants some metres tall

struct Stem {
  std::vector<Vec3> points, handles_in, handles_out;
  std::vector<float> radii;
  bool operator==(const Stem&) const = default;
};
using StemsByPath = std::map<BranchPath, Stem>;

StemsByPath stems_of(const Plant& plant) {
  StemsByPath stems;
  for (std::size_t s = 0; s < plant.stems.size(); ++s) {
    Stem& stem = stems[path_of(plant, s)];
    for (std::size_t k = plant.stems.first_knot[s]; k < plant.stems.first_knot[s + 1]; ++k) {
      stem.points.push_back(plant.knots.point_m[k]);
      stem.handles_in.push_back(plant.knots.handle_in_m[k]);
      stem.handles_out.push_back(plant.knots.handle_out_m[k]);
      stem.radii.push_back(plant.knots.radius_m[k]);
    }
  }
  return stems;
}

Plant reshaped(const JointedPlant& plant, const Overrides& overrides, const PlantPart* part = nullptr) {
  const ChangeGraph changes(overrides);
  Plant shaped;
  Reshaper(plant).reshape(&changes, part, shaped);
  return shaped;
}

Overrides with(const BranchPath& path, const Override& entry) {
  Overrides overrides;
  set_override(overrides.at(path).set, entry);
  return overrides;
}

bool starts_with(const BranchPath& path, const BranchPath& start) {
  return path.size() >= start.size() && std::equal(start.begin(), start.end(), path.begin());
}

BranchPath any_path(const Plant& plant) {
  return path_of(plant, *rc::gen::inRange<std::size_t>(0, plant.stems.size()));
}

Override any_override() {
  const auto quantity = *rc::gen::elementOf(std::vector<Quantity>{
      Quantity::length, Quantity::position, Quantity::down_angle, Quantity::rotation, Quantity::curvature,
      Quantity::curvature_back, Quantity::radius, Quantity::child_count, Quantity::removed});
  const double part = *rc::gen::inRange(0, 1001) / 1000.0;
  const bool is_private = *rc::gen::arbitrary<bool>();
  switch (quantity) {
    case Quantity::length:
    case Quantity::radius:
    case Quantity::child_count:
      return {quantity, Relation::factor, 0.3 + part, is_private};
    case Quantity::position:
      return {quantity, Relation::value, part, is_private};
    case Quantity::removed:
      return {quantity, Relation::value, 1, is_private};
    default:
      return {quantity, part < 0.5 ? Relation::offset : Relation::value, 200 * part - 100, is_private};
  }
}

Overrides any_overrides(const Plant& plant) {
  Overrides overrides;
  for (int i = *rc::gen::inRange(0, 5); i > 0; --i)
    set_override(overrides.at(any_path(plant)).set, any_override());
  return overrides;
}

/// The leaves of each stem, in the order of the plant: positions, axes and sides.
std::map<BranchPath, std::vector<Vec3>> leaves_by_path(const JointedPlant& plant) {
  std::map<BranchPath, std::vector<Vec3>> leaves;
  for (std::size_t i = 0; i < plant.plant.leaves.size(); ++i) {
    const std::int32_t stem = plant.joints.organs[plant.joints.organ_of_leaf[i]].stem;
    if (stem >= 0)
      leaves[path_of(plant.plant, static_cast<std::size_t>(stem))].push_back(
          plant.plant.leaves.position_m[i]);
  }
  return leaves;
}

bool same_leaves(const Leaves& a, const Leaves& b) {
  return a.position_m == b.position_m && a.axis == b.axis && a.side == b.side && a.length_m == b.length_m &&
         a.width_m == b.width_m && a.kind == b.kind && a.color == b.color;
}

RC_GTEST_PROP(Reshape, WithoutOverridesIsThePlant, ()) {
  const JointedPlant jointed = any_jointed_plant();
  const Plant &plant = jointed.plant, shaped = reshaped(jointed, {});
  RC_ASSERT(shaped.stems.first_knot == plant.stems.first_knot);
  RC_ASSERT(shaped.stems.parent == plant.stems.parent);
  RC_ASSERT(shaped.stems.level == plant.stems.level);
  RC_ASSERT(shaped.stems.path_key == plant.stems.path_key);
  RC_ASSERT(shaped.stems.origin == plant.stems.origin);
  RC_ASSERT(shaped.stems.child_index == plant.stems.child_index);
  RC_ASSERT(stems_of(shaped) == stems_of(plant));
  RC_ASSERT(same_leaves(shaped.leaves, plant.leaves));
  RC_ASSERT(shaped.tree_scale_m == plant.tree_scale_m);
}

RC_GTEST_PROP(Reshape, ChangesNothingOutsideOfTheBranch, ()) {
  const JointedPlant jointed = any_jointed_plant();
  const BranchPath path = any_path(jointed.plant);
  const Plant shaped = reshaped(jointed, with(path, any_override()));
  const StemsByPath after = stems_of(shaped);
  for (const auto& [other, stem] : stems_of(jointed.plant))
    if (!starts_with(other, path)) RC_ASSERT(after.contains(other) && after.at(other) == stem);
  for (const auto& [owner, places] : leaves_by_path(jointed))
    for (const Vec3& place : places)
      if (!starts_with(owner, path)) RC_ASSERT(std::ranges::count(shaped.leaves.position_m, place) >= 1);
}

RC_GTEST_PROP(Reshape, RemovesExactlyTheBranchAndAllOnIt, ()) {
  const JointedPlant jointed = any_jointed_plant();
  const BranchPath path = any_path(jointed.plant);
  const Plant shaped = reshaped(jointed, with(path, {Quantity::removed, Relation::value, 1, true}));
  StemsByPath expected = stems_of(jointed.plant);
  std::erase_if(expected, [&](const auto& stem) { return starts_with(stem.first, path); });
  RC_ASSERT(stems_of(shaped) == expected);
  std::size_t leaves = jointed.plant.leaves.size();
  for (const auto& [owner, places] : leaves_by_path(jointed))
    if (starts_with(owner, path)) leaves -= places.size();
  RC_ASSERT(shaped.leaves.size() == leaves);
}

RC_GTEST_PROP(Reshape, LengthScalesTheStemAndWhatStandsOnItKeepsItsPlace, ()) {
  const JointedPlant jointed = any_jointed_plant();
  const BranchPath path = any_path(jointed.plant);
  const float factor = 0.2f + static_cast<float>(*rc::gen::inRange(0, 300)) / 100;
  const Plant shaped = reshaped(jointed, with(path, {Quantity::length, Relation::factor, factor, true}));
  const ArcLengths before(jointed.plant), after(shaped);
  for (std::size_t s = 0; s < shaped.stems.size(); ++s) {
    const float grown_m = before.of_stem_m(jointed.plant.stems, s);
    const bool is_it = path_of(shaped, s) == path;
    RC_ASSERT(std::fabs(after.of_stem_m(shaped.stems, s) - grown_m * (is_it ? factor : 1)) < kRounding);
    if (shaped.stems.origin[s] < 0) continue;
    const auto origin = static_cast<std::size_t>(shaped.stems.origin[s]);
    const StemPlace place = jointed.joints.stem_place[s];
    const auto off = [&](const Plant& plant) {
      return point_at(plant.stems, plant.knots, s, {}) - point_at(plant.stems, plant.knots, origin, place);
    };
    RC_ASSERT(length(off(shaped) - off(jointed.plant)) < kRounding);
  }
}

RC_GTEST_PROP(Reshape, APartIsWhatItIsInTheWhole, ()) {
  const JointedPlant jointed = any_jointed_plant();
  const Overrides overrides = any_overrides(jointed.plant);
  const Plant whole = reshaped(jointed, overrides);
  const StemsByPath all = stems_of(whole);
  std::size_t stems = 0, leaves = 0;
  for (std::size_t s = 0; s < jointed.plant.stems.size(); ++s) {
    const PlantPart alone{path_of(jointed.plant, s), true}, with_all{alone.path, false};
    const Plant one = reshaped(jointed, overrides, &alone), branch = reshaped(jointed, overrides, &with_all);
    stems += one.stems.size();
    leaves += one.leaves.size();
    RC_ASSERT(one.stems.size() == (all.contains(alone.path) ? 1u : 0u));
    if (one.stems.size() == 1) RC_ASSERT(stems_of(one).begin()->second == all.at(alone.path));
    for (const auto& [path, stem] : stems_of(branch)) {
      BranchPath full(alone.path.begin(), alone.path.end() - 1);
      full.insert(full.end(), path.begin(), path.end());
      RC_ASSERT(all.at(full) == stem);
    }
    const auto below = [&](const auto& stem) { return starts_with(stem.first, alone.path); };
    RC_ASSERT(branch.stems.size() == static_cast<std::size_t>(std::ranges::count_if(all, below)));
    for (const Vec3& place : branch.leaves.position_m)
      RC_ASSERT(std::ranges::count(whole.leaves.position_m, place) >= 1);
  }
  RC_ASSERT(stems == whole.stems.size());
  RC_ASSERT(leaves == whole.leaves.size());
}

constexpr AxisPoint kCrooked[] = {{0.3, 0, 0.4}, {0.2, -0.5, 0.6}, {0, 0.4, 1.2}},
                    kStraight[] = {{0, 0, 1}, {0, 0, 2}, {0, 0, 3}};

Overrides on_axis(const BranchPath& path, std::span<const AxisPoint> points, AxisFrame frame) {
  Overrides overrides;
  overrides.at(path).set.axis = DrawnAxis{{points.begin(), points.end()}, frame};
  return overrides;
}

RC_GTEST_PROP(Reshape, AStemOnAnAxisHasItsKnotsThere, ()) {
  const JointedPlant jointed = any_jointed_plant();
  const BranchPath path = any_path(jointed.plant);
  const Plant shaped = reshaped(jointed, on_axis(path, kCrooked, AxisFrame::world));
  const AxisCurve curve = make_axis(kCrooked);
  const AxisArcs arcs(curve);
  const ArcLengths before(jointed.plant);
  for (std::size_t s = 0; s < shaped.stems.size(); ++s) {
    if (path_of(shaped, s) != path) continue;
    const float length_m = before.of_stem_m(jointed.plant.stems, s);
    const std::size_t first = shaped.stems.first_knot[s];
    for (std::size_t k = first; k < shaped.stems.first_knot[s + 1]; ++k) {
      const AxisPoint at =
          axis_point(curve, arcs.place_at(before.at_knot_m(k) / length_m)) * (length_m / arcs.length());
      const Vec3 drawn_m{static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)};
      RC_ASSERT(length(shaped.knots.point_m[k] - shaped.knots.point_m[first] - drawn_m) < kRounding);
    }
  }
}

/// Its children are as far from their place on it as before.
RC_GTEST_PROP(Reshape, WhatStandsOnAnAxisKeepsItsPlace, ()) {
  const JointedPlant jointed = any_jointed_plant();
  const Plant shaped = reshaped(jointed, on_axis(any_path(jointed.plant), kCrooked, AxisFrame::parent));
  for (std::size_t s = 0; s < shaped.stems.size(); ++s) {
    if (shaped.stems.origin[s] < 0) continue;
    const auto off_m = [&](const Plant& plant) {
      const auto origin = static_cast<std::size_t>(plant.stems.origin[s]);
      return length(point_at(plant.stems, plant.knots, s, {}) -
                    point_at(plant.stems, plant.knots, origin, jointed.joints.stem_place[s]));
    };
    RC_ASSERT(std::fabs(off_m(shaped) - off_m(jointed.plant)) < kRounding);
  }
}

RC_GTEST_PROP(Reshape, AStraightAxisInTheParentsFrameGoesOnAsTheStemBegins, ()) {
  const JointedPlant jointed = any_jointed_plant();
  const std::size_t stem = *rc::gen::inRange<std::size_t>(0, jointed.plant.stems.size());
  RC_PRE(jointed.plant.stems.origin[stem] >= 0);
  const Plant shaped = reshaped(jointed, on_axis(path_of(jointed.plant, stem), kStraight, AxisFrame::parent));
  const Vec3 first = direction_at(jointed.plant.stems, jointed.plant.knots, stem, {});
  const Vec3 whole_m = shaped.knots.point_m[shaped.stems.first_knot[stem + 1] - 1] -
                       shaped.knots.point_m[shaped.stems.first_knot[stem]];
  RC_ASSERT(dot(normalized(whole_m), first) > 1 - 1e-5f);
}

RC_GTEST_PROP(Reshape, AFullTurnIsNone, ()) {
  const JointedPlant jointed = any_jointed_plant();
  const auto quantity = *rc::gen::element(Quantity::rotation, Quantity::down_angle);
  const Plant shaped =
      reshaped(jointed, with(any_path(jointed.plant), {quantity, Relation::offset, 360, true}));
  for (std::size_t k = 0; k < shaped.knots.size(); ++k)
    RC_ASSERT(length(shaped.knots.point_m[k] - jointed.plant.knots.point_m[k]) < kRounding);
  for (std::size_t i = 0; i < shaped.leaves.size(); ++i)
    RC_ASSERT(length(shaped.leaves.position_m[i] - jointed.plant.leaves.position_m[i]) < kRounding);
}

RC_GTEST_PROP(Reshape, TurnsKeepTheFormOfABranch, ()) {
  const JointedPlant jointed = any_jointed_plant();
  const BranchPath path = any_path(jointed.plant);
  const auto quantity = *rc::gen::element(Quantity::rotation, Quantity::down_angle, Quantity::position);
  const double number = quantity == Quantity::position ? 0.3 : 77;
  const Plant shaped = reshaped(jointed, with(path, {quantity, Relation::value, number, true}));
  std::vector<std::size_t> knots;
  for (std::size_t s = 0; s < shaped.stems.size(); ++s)
    for (std::size_t k = shaped.stems.first_knot[s];
         starts_with(path_of(shaped, s), path) && k < shaped.stems.first_knot[s + 1]; ++k)
      knots.push_back(k);
  for (const std::size_t a : knots)
    for (const std::size_t b : knots) {
      const float before_m = length(jointed.plant.knots.point_m[a] - jointed.plant.knots.point_m[b]),
                  after_m = length(shaped.knots.point_m[a] - shaped.knots.point_m[b]);
      RC_ASSERT(std::fabs(before_m - after_m) < kRounding);
    }
}

/// A trunk of 4 m that leans by 10° to the right, and a branch at half of it that goes to the right.
JointedPlant straight_plant() {
  JointedPlant jointed;
  Plant& plant = jointed.plant;
  plant.stems.first_knot.push_back(0);
  const auto add = [&](std::int32_t origin, Vec3 base_m, Vec3 along, int knots) {
    for (int k = 0; k < knots; ++k) {
      const Vec3 point_m = base_m + along * static_cast<float>(k);
      plant.knots.point_m.push_back(point_m);
      plant.knots.handle_in_m.push_back(point_m - along * (1 / 3.f));
      plant.knots.handle_out_m.push_back(point_m + along * (1 / 3.f));
      plant.knots.radius_m.push_back(0.1f);
    }
    plant.stems.first_knot.push_back(static_cast<std::uint32_t>(plant.knots.size()));
    plant.stems.parent.push_back(origin);
    plant.stems.origin.push_back(origin);
    plant.stems.level.push_back(origin < 0 ? 0 : 1);
    plant.stems.child_index.push_back(0);
    plant.stems.path_key.push_back(0);
    jointed.joints.stem_place.push_back({2, 0});
  };
  const Vec3 up = turn_about({0, 1, 0}, 10)({0, 0, 1});
  add(-1, {}, up, 5);
  add(0, up * 2, turn_about({0, 1, 0}, 40)(up), 9);
  return jointed;
}

float angle_deg(Vec3 a, Vec3 b) { return std::acos(std::clamp(dot(a, b), -1.f, 1.f)) * 57.29578f; }

Vec3 heading(const Plant& plant, std::size_t stem, StemPlace place = {}) {
  return direction_at(plant.stems, plant.knots, stem, place);
}

TEST(Reshape, ValuesAreWhatIsMeasuredAfterwards) {
  const JointedPlant jointed = straight_plant();
  const Plant lowered = reshaped(jointed, with({0, 0}, {Quantity::down_angle, Relation::value, 70, true}));
  EXPECT_NEAR(angle_deg(heading(lowered, 0), heading(lowered, 1)), 70, 0.01);
  EXPECT_LT(heading(lowered, 1).z, heading(jointed.plant, 1).z) << "away from the trunk is down";
  const Plant upright = reshaped(jointed, with({0}, {Quantity::down_angle, Relation::value, 0, true}));
  EXPECT_NEAR(heading(upright, 0).z, 1, 1e-5);
  EXPECT_NEAR(angle_deg(heading(upright, 0), heading(upright, 1)), 40, 0.01) << "what it bears turns with it";
  const Plant moved = reshaped(jointed, with({0, 0}, {Quantity::position, Relation::value, 0.25, true}));
  EXPECT_NEAR(length(moved.knots.point_m[5]), 1, 1e-5);
  const Plant longer = reshaped(jointed, with({0, 0}, {Quantity::length, Relation::value, 3, true}));
  EXPECT_NEAR(ArcLengths(longer).of_stem_m(longer.stems, 1), 3, 1e-5);
  const Plant thicker = reshaped(jointed, with({0, 0}, {Quantity::radius, Relation::value, 0.25, true}));
  EXPECT_FLOAT_EQ(thicker.knots.radius_m[5], 0.25f);
}

TEST(Reshape, RotationIsAboutTheTrunkFromTheRight) {
  const JointedPlant jointed = straight_plant();
  const Plant back = reshaped(jointed, with({0, 0}, {Quantity::rotation, Relation::value, 90, true}));
  const Vec3 along = heading(jointed.plant, 0);
  EXPECT_NEAR(angle_deg(along, heading(back, 1)), 40, 0.01);
  EXPECT_NEAR(angle_about_deg(along, {1, 0, 0}, heading(back, 1)), 90, 0.01);
  const Plant trunk = reshaped(jointed, with({0}, {Quantity::rotation, Relation::offset, 90, true}));
  EXPECT_NEAR(heading(trunk, 0).y, heading(jointed.plant, 0).x, 1e-5);
  EXPECT_NEAR(heading(trunk, 1).y, heading(jointed.plant, 1).x, 1e-5);
}

TEST(Reshape, CurvatureBendsAwayFromTheParentAndKeepsTheLength) {
  const JointedPlant jointed = straight_plant();
  const StemPlace middle{4, 0}, tip{8, 0};
  const Plant bent = reshaped(jointed, with({0, 0}, {Quantity::curvature, Relation::value, 80, true}));
  EXPECT_NEAR(angle_deg(heading(bent, 1), heading(bent, 1, tip)), 80, 0.01);
  EXPECT_NEAR(angle_deg(heading(bent, 1), heading(bent, 1, middle)), 40, 0.01);
  EXPECT_LT(heading(bent, 1, tip).z, heading(bent, 1).z);
  EXPECT_NEAR(ArcLengths(bent).of_stem_m(bent.stems, 1), 8, 0.01);
  const Plant back = reshaped(jointed, with({0, 0}, {Quantity::curvature_back, Relation::value, 60, true}));
  EXPECT_NEAR(angle_deg(heading(back, 1), heading(back, 1, middle)), 0, 0.05);
  EXPECT_NEAR(angle_deg(heading(back, 1), heading(back, 1, tip)), 60, 0.01);
  const Plant trunk = reshaped(jointed, with({0}, {Quantity::curvature, Relation::offset, 40, true}));
  EXPECT_NEAR(angle_deg(heading(trunk, 0, {2, 0}), heading(trunk, 1)), 40, 0.01)
      << "branches follow the bend";
}

RC_GTEST_PROP(Reshape, AChildCountKeepsTheFirstOnes, ()) {
  const JointedPlant jointed = any_jointed_plant();
  const BranchPath path = any_path(jointed.plant);
  const int most = *rc::gen::inRange(0, 4);
  const Plant shaped = reshaped(
      jointed, with(path, {Quantity::child_count, Relation::value, static_cast<double>(most), true}));
  StemsByPath expected = stems_of(jointed.plant);
  std::erase_if(expected, [&](const auto& stem) {
    return starts_with(stem.first, path) && stem.first.size() > path.size() &&
           stem.first[path.size()] >= static_cast<std::uint32_t>(most);
  });
  RC_ASSERT(stems_of(shaped) == expected);
}

RC_GTEST_PROP(Reshape, NeverGivesWhatIsNotFinite, ()) {
  const JointedPlant jointed = any_jointed_plant();
  Overrides overrides;
  for (int i = 0; i < 6; ++i) {
    Override entry = any_override();
    if (entry.relation != Relation::value) entry.number *= std::pow(10, *rc::gen::inRange(-6, 6));
    set_override(overrides.at(any_path(jointed.plant)).set, entry);
  }
  Plant shaped;
  try {
    shaped = reshaped(jointed, overrides);
  } catch (const InputError&) {
  }
  for (const auto* points : {&shaped.knots.point_m, &shaped.knots.handle_in_m, &shaped.knots.handle_out_m,
                             &shaped.leaves.position_m, &shaped.leaves.axis, &shaped.leaves.side})
    for (const Vec3& p : *points) RC_ASSERT(std::isfinite(p.x + p.y + p.z));
  for (const float radius_m : shaped.knots.radius_m) RC_ASSERT(std::isfinite(radius_m) && radius_m >= 0);
}

TEST(Reshape, APathThatDoesNotGrowIsAnEmptyPart) {
  const PlantPart part{{0, 7}, false};
  EXPECT_EQ(reshaped(straight_plant(), {}, &part).stems.size(), 0u);
}

}  // namespace
}  // namespace espalier
