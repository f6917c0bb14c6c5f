// Overrides of single branches in grown trees: what they change, and that they change nothing else.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <espalier/models/preset.h>
#include <espalier/overrides/change_graph.h>
#include <espalier/weber_penn/model.h>
#include <espalier/weber_penn/table/parameters.h>

namespace espalier {
namespace {

constexpr float kRoundingM = 1e-4f;  ///< of trees some ten metres tall

/// A stem and its leaves do not matter; its curve and radii do.
struct Curve {
  std::vector<Vec3> points;
  std::vector<float> radii;
  bool operator==(const Curve&) const = default;
};

/// Up to the rounding of floats: vectors grow plain stems, the plain formulas those beside an override.
bool are_near(const Curve& a, const Curve& b) {
  const auto same_place = [](Vec3 p, Vec3 q) { return length(p - q) < kRoundingM; };
  const auto same_radius = [](float p, float q) { return std::fabs(p - q) < 1e-6f; };
  return std::ranges::equal(a.points, b.points, same_place) &&
         std::ranges::equal(a.radii, b.radii, same_radius);
}

using Branches = std::map<BranchPath, Curve>;

Plant grow(const ParameterValues& values, const Overrides& overrides, const PlantPart* part = nullptr) {
  const ChangeGraph changes(overrides);
  GrowthSettings settings{{50'000, 300'000}};
  settings.changes = &changes;
  settings.only_part = part;
  Plant plant;
  EXPECT_TRUE(weber_penn_model().generate(values, 1, settings, plant).grown);
  return plant;
}

Branches branches_of(const Plant& plant) {
  Branches branches;
  for (std::size_t stem = 0; stem < plant.stems.size(); ++stem) {
    Curve curve;
    for (std::size_t k = plant.stems.first_knot[stem]; k < plant.stems.first_knot[stem + 1]; ++k) {
      curve.points.push_back(plant.knots.point_m[k]);
      curve.radii.push_back(plant.knots.radius_m[k]);
    }
    branches[path_of(plant, stem)] = curve;
  }
  return branches;
}

Branches grown(const ParameterValues& values, const Overrides& overrides) {
  return branches_of(grow(values, overrides));
}

ParameterValues species(const std::string& name) { return load_preset(name).values; }

/// Small enough for many trees: fewer branches and leaves.
ParameterValues small(const std::string& name) {
  ParameterValues values = species(name);
  const ParameterTable& table = weber_penn_table();
  for (const char* count : {"branches[1]", "branches[2]", "branches[3]"}) {
    double& value = values[table.index_of(count)];
    if (value > 12) value = 12;
  }
  double& leaves = values[table.index_of("leaf_blos_num")];
  if (leaves > 5) leaves = 5;
  return values;
}

Overrides with(const BranchPath& path, const Override& entry) {
  Overrides overrides;
  set_override(overrides.at(path).set, entry);
  return overrides;
}

bool starts_with(const BranchPath& path, const BranchPath& start) {
  return path.size() >= start.size() && std::equal(start.begin(), start.end(), path.begin());
}

float length_of(const Curve& curve) {
  float sum = 0;
  for (std::size_t i = 1; i < curve.points.size(); ++i) sum += length(curve.points[i] - curve.points[i - 1]);
  return sum;
}

constexpr const char* kSpecies[] = {"quaking_aspen", "lombardy_poplar", "palm", "acer", "small_pine"};

Override any_override() {
  const auto quantity = static_cast<Quantity>(*rc::gen::inRange(0, 10));
  const double part = *rc::gen::inRange(0, 1001) / 1000.0;
  const bool is_private = *rc::gen::arbitrary<bool>();
  switch (quantity) {
    case Quantity::length:
    case Quantity::radius:
    case Quantity::child_count:
      return {quantity, Relation::factor, 0.3 + part, is_private};
    case Quantity::position:
      return {quantity, Relation::offset, part - 0.5, is_private};
    case Quantity::seed:
      return {quantity, Relation::value, std::floor(1 + 1000 * part), is_private};
    case Quantity::removed:
      return {quantity, Relation::value, 1, is_private};
    default:
      return {quantity, Relation::offset, 200 * part - 100, is_private};
  }
}

RC_GTEST_PROP(BranchOverrides, ChangeNothingOutsideOfTheirBranch, ()) {
  const ParameterValues values =
      small(*rc::gen::elementOf(std::vector<std::string>(std::begin(kSpecies), std::end(kSpecies))));
  const Branches plain = grown(values, {});
  auto place = plain.begin();
  std::advance(place, *rc::gen::inRange<std::size_t>(0, plain.size()));
  const BranchPath path = place->first;
  RC_PRE(path.size() > 1);
  const Override of_nothing{Quantity::curvature, Relation::offset, 0, true};
  const Branches before = grown(values, with(path, of_nothing)),
                 after = grown(values, with(path, any_override()));
  for (const auto& [other, curve] : before) {
    if (starts_with(other, path)) continue;
    RC_ASSERT(after.contains(other));
    RC_ASSERT(after.at(other) == curve);  // bit for bit
    RC_ASSERT(are_near(plain.at(other), curve));
  }
}

RC_GTEST_PROP(BranchOverrides, APartGrowsAsItDoesInTheWholePlant, ()) {
  const ParameterValues values =
      small(*rc::gen::elementOf(std::vector<std::string>(std::begin(kSpecies), std::end(kSpecies))));
  Overrides overrides;
  for (int i = 0; i < 4; ++i)
    set_override(overrides.at({0, static_cast<std::uint32_t>(*rc::gen::inRange(0, 12))}).set, any_override());
  set_override(overrides.at({0}).set, {Quantity::curvature, Relation::offset, 20, true});
  const Branches whole = grown(values, overrides);
  auto place = whole.begin();
  std::advance(place, *rc::gen::inRange<std::size_t>(0, whole.size()));
  const PlantPart part{place->first, *rc::gen::arbitrary<bool>()};
  const Plant alone = grow(values, overrides, &part);
  // Paths inside of the part begin with the part's own; its stems keep their order from there.
  std::vector<Curve> expected, got;
  for (const auto& [path, curve] : whole)
    if (part.alone ? path == part.path : starts_with(path, part.path)) expected.push_back(curve);
  for (const auto& [path, curve] : branches_of(alone)) got.push_back(curve);
  RC_ASSERT(got.size() == expected.size());
  for (const Curve& curve : expected)
    RC_ASSERT(std::any_of(got.begin(), got.end(), [&](const Curve& one) { return are_near(one, curve); }));
}

TEST(BranchOverrides, LengthAndRadiusFollowTheirFactors) {
  const ParameterValues values = species("quaking_aspen");
  const Branches before = grown(values, {});
  Overrides overrides = with({0, 20}, {Quantity::length, Relation::factor, 0.5, true});
  set_override(overrides.at({0, 20}).set, {Quantity::radius, Relation::factor, 3, true});
  const Branches after = grown(values, overrides);
  EXPECT_NEAR(length_of(after.at({0, 20})) / length_of(before.at({0, 20})), 0.5, 0.03);
  EXPECT_GT(after.at({0, 20}).radii.front(), before.at({0, 20}).radii.front());
}

TEST(BranchOverrides, APublicLengthHoldsForTheBranchesAboveToo) {
  const ParameterValues values = species("quaking_aspen");
  const Branches shared = grown(values, with({0, 20}, {Quantity::length, Relation::factor, 0.5, false}));
  const Branches own = grown(values, with({0, 20}, {Quantity::length, Relation::factor, 0.5, true}));
  const BranchPath twig{0, 20, 5};
  ASSERT_TRUE(shared.contains(twig) && own.contains(twig));
  EXPECT_NEAR(length_of(shared.at(twig)) / length_of(own.at(twig)), 0.5, 0.05);
}

TEST(BranchOverrides, RemovedBranchesAreGoneWithAllTheyBear) {
  const Branches after =
      grown(species("quaking_aspen"), with({0, 20}, {Quantity::removed, Relation::value, 1, false}));
  for (const auto& [path, curve] : after) EXPECT_FALSE(starts_with(path, {0, 20})) << to_string(path);
}

TEST(BranchOverrides, APositionMovesTheBaseAlongTheParent) {
  const ParameterValues values = species("quaking_aspen");
  const Branches before = grown(values, {});
  const float trunk_m = before.at({0}).points.back().z;
  for (const double position : {0.1, 0.5, 0.9}) {
    const Branches after =
        grown(values, with({0, 20}, {Quantity::position, Relation::value, position, true}));
    EXPECT_NEAR(after.at({0, 20}).points.front().z / trunk_m, position, 0.06) << position;
  }
}

TEST(BranchOverrides, TheDownAngleIsTheOneAskedFor) {
  ParameterValues values = species("quaking_aspen");
  const ParameterTable& table = weber_penn_table();
  for (const char* name : {"curve_v[0]", "curve_v[1]", "curve[1]", "bend_v[1]"})
    values[table.index_of(name)] = 0;
  const Branches after = grown(values, with({0, 20}, {Quantity::down_angle, Relation::value, 30, true}));
  const Curve& branch = after.at({0, 20});
  const Vec3 heading = normalized(branch.points[1] - branch.points[0]);
  EXPECT_NEAR(std::acos(heading.z) * 180 / M_PI, 30, 2);
}

TEST(BranchOverrides, CurvatureBendsAStemByAsMuchAsItSays) {
  ParameterValues values = species("quaking_aspen");
  const ParameterTable& table = weber_penn_table();
  for (const char* name : {"curve[0]", "curve_v[0]", "bend_v[0]", "tropism_x", "tropism_y"})
    values[table.index_of(name)] = 0;
  const Branches after = grown(values, with({0}, {Quantity::curvature, Relation::value, 50, true}));
  const Curve& trunk = after.at({0});
  const Vec3 tip = normalized(trunk.points.back() - trunk.points[trunk.points.size() - 2]);
  const double segments = values[table.index_of("curve_res[0]")];
  EXPECT_NEAR(std::acos(tip.z) * 180 / M_PI, 50 * (segments - 1) / segments,
              5);  // no turn after the last segment
}

TEST(BranchOverrides, ABendOfTheSecondHalfLeavesTheFirstWhereItWas) {
  const ParameterValues values = species("quaking_aspen");
  const Curve before = grown(values, {}).at({0});
  const Curve after =
      grown(values, with({0}, {Quantity::curvature_back, Relation::offset, 60, true})).at({0});
  ASSERT_EQ(after.points.size(), before.points.size());
  const std::size_t points = before.points.size(), middle = points / 2;
  for (std::size_t i = 0; i < middle; ++i) EXPECT_LT(length(after.points[i] - before.points[i]), 1e-4) << i;
  const auto tip = [&](const Curve& curve) {
    return normalized(curve.points[points - 1] - curve.points[points - 2]);
  };
  // No turn after the last segment, and none less than half a turn at the middle.
  const double turned_deg = std::acos(dot(tip(after), tip(before))) * 180 / M_PI;
  EXPECT_GT(turned_deg, 30);
  EXPECT_LT(turned_deg, 65);
}

TEST(BranchOverrides, ASeedRenewsTheBranchAndAllOnIt) {
  const ParameterValues values = species("quaking_aspen");
  const Branches before = grown(values, {});
  const Branches after = grown(values, with({0, 20}, {Quantity::seed, Relation::value, 5, true}));
  EXPECT_NE(after.at({0, 20}), before.at({0, 20}));
  EXPECT_NE(after.at({0, 20, 3}), before.at({0, 20, 3}));
  EXPECT_EQ(after.at({0, 20}).points.front(), before.at({0, 20}).points.front());
}

TEST(BranchOverrides, ChildCountsAreThoseOfTheBranchAlone) {
  const ParameterValues values = species("quaking_aspen");
  const auto children = [](const Branches& branches, const BranchPath& of) {
    return std::count_if(branches.begin(), branches.end(), [&](const auto& branch) {
      return branch.first.size() == of.size() + 1 && starts_with(branch.first, of);
    });
  };
  const Branches before = grown(values, {});
  const Branches after = grown(values, with({0, 20}, {Quantity::child_count, Relation::factor, 0.5, true}));
  EXPECT_NEAR(static_cast<double>(children(after, {0, 20})) / static_cast<double>(children(before, {0, 20})),
              0.5, 0.1);
  EXPECT_EQ(children(after, {0, 21}), children(before, {0, 21}));
}

/// [Boudon et al. 2003, Fig. 10]: there a shaped branch was lost when the number of branches changed and came
/// back.
TEST(BranchOverrides, ADormantNodeActsAgainWhenItsBranchReturns) {
  ParameterValues values = species("quaking_aspen");
  double& branches = values[weber_penn_table().index_of("branches[1]")];
  const Overrides overrides = with({0, 30}, {Quantity::curvature, Relation::offset, 90, true});
  const Branches first = grown(values, overrides);
  const double before = branches;
  branches = 10;
  const Branches thinned = grown(values, overrides);
  EXPECT_FALSE(thinned.contains({0, 30}));
  branches = before;
  EXPECT_EQ(grown(values, overrides), first);
}

TEST(BranchOverrides, StemsThatSplitOffCanBeOverriddenToo) {
  const ParameterValues values = species("acer");
  const Branches before = grown(values, {});
  const auto split = std::find_if(before.begin(), before.end(), [](const auto& branch) {
    return branch.first.size() == 2 && branch.first.back() >= kFirstSplit;
  });
  ASSERT_NE(split, before.end()) << "an acer whose trunk does not split";
  const Branches after = grown(values, with(split->first, {Quantity::removed, Relation::value, 1, false}));
  EXPECT_FALSE(after.contains(split->first));
  EXPECT_EQ(after.at({0}), before.at({0}));
}

}  // namespace
}  // namespace espalier
