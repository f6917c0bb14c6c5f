// What each curve along stems changes, by how much, and that it changes nothing else.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <espalier/core/curves/parameter_curves.h>
#include <espalier/weber_penn/grow.h>
#include <espalier/weber_penn/model.h>
#include <espalier/weber_penn/scalar/stem.h>
#include <espalier/weber_penn/table/parameters.h>

namespace espalier::along_stems {  // apart from what other files of this room call so
namespace {

constexpr double kHeightM = 13, kBare = 0.2;
const std::vector<double> kHump{0.4, 1.1, 1.2, 0.2};

const ParameterTable& table() { return weber_penn_table(); }

void set(ParameterValues& values, const char* name, double value) { values[table().index_of(name)] = value; }

void set_along(ParameterValues& values, const std::string& name, const std::vector<double>& numbers) {
  set_curve(table(), *table().find_curve(name), numbers, "test", values);
}

Plant grow(const ParameterValues& values, Seed seed = 1) {
  Plant plant;
  EXPECT_TRUE(weber_penn_model().generate(values, seed, {}, plant).grown);
  return plant;
}

/// An upright cylinder of one segment, bare in its lower fifth, with straight branches whose radius does not
/// depend on their length.
ParameterValues plain_tree() {
  ParameterValues values = table().defaults();
  for (const char* name : {"g_scale_v", "curve_v[0]", "flare", "leaf_blos_num", "taper[0]", "ratio_power",
                           "down_angle_v[1]", "curve[1]", "curve_v[1]", "bend_v[1]"})
    set(values, name, 0);
  set(values, "levels", 2);
  set(values, "curve_res[0]", 1);
  set(values, "base_size[0]", kBare);
  return values;
}

/// Leaves on the trunk alone.
ParameterValues leafy_trunk() {
  ParameterValues values = plain_tree();
  set(values, "levels", 1);
  set(values, "leaf_blos_num", 300);
  set(values, "leaf_bend", 0);
  return values;
}

Vec3 base(const Plant& plant, std::size_t stem) { return plant.knots.point_m[plant.stems.first_knot[stem]]; }
Vec3 tip(const Plant& plant, std::size_t stem) {
  return plant.knots.point_m[plant.stems.first_knot[stem + 1] - 1];
}
Vec3 heading(const Plant& plant, std::size_t stem) {
  return normalized(plant.knots.handle_out_m[plant.stems.first_knot[stem]] - base(plant, stem));
}
Vec3 last_heading(const Plant& plant) { return normalized(tip(plant, 0) - plant.knots.handle_in_m.back()); }

double above_base(float height_m) { return (height_m / kHeightM - kBare) / (1 - kBare); }
double hump_at(double x) { return curve_value(make_curve(kHump), x); }

/// The share of a curve's integral below x.
double share_below(const std::vector<double>& numbers, double x) {
  constexpr int kSteps = 2000;
  double below = 0, whole = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double at = (i + 0.5) / kSteps, value = curve_value(make_curve(numbers), at);
    whole += value;
    if (at < x) below += value;
  }
  return below / whole;
}

struct BeforeAndAfter {
  Plant before, after;
};

/// The plant without a curve, and with it.
BeforeAndAfter grow_with(ParameterValues values, const std::string& curve,
                         const std::vector<double>& numbers) {
  Plant before = grow(values);
  set_along(values, curve, numbers);
  return {std::move(before), grow(values)};
}

/// All stems on the trunk are still there, moved to where kHump has the share below them that was there
/// before.
void expect_spread_by_hump(const BeforeAndAfter& trees) {
  const auto& [before, after] = trees;
  ASSERT_EQ(before.stems.path_key, after.stems.path_key);
  for (std::size_t stem = 1; stem < before.stems.size(); ++stem)
    EXPECT_NEAR(share_below(kHump, above_base(base(after, stem).z)), above_base(base(before, stem).z), 2e-3)
        << stem;
}

TEST(LengthAlong, ScalesStemsByTheirPlaceAndMovesNone) {
  const auto [before, after] = grow_with(plain_tree(), "length_along[1]", kHump);
  ASSERT_EQ(before.stems.path_key, after.stems.path_key);
  ASSERT_GT(before.stems.size(), 30u);
  for (std::size_t stem = 1; stem < before.stems.size(); ++stem) {
    EXPECT_EQ(base(before, stem), base(after, stem));
    EXPECT_LT(length(heading(before, stem) - heading(after, stem)), 1e-5f);
    EXPECT_NEAR(length(tip(after, stem) - base(after, stem)) / length(tip(before, stem) - base(before, stem)),
                hump_at(above_base(base(before, stem).z)), 2e-3)
        << stem;
  }
}

TEST(LengthAlong, OfOneNumberIsAFactorOfLength) {
  ParameterValues by_curve = plain_tree(), by_length = plain_tree();
  set_along(by_curve, "length_along[1]", {1.5});
  set(by_length, "length[1]", 1.5 * by_length[table().index_of("length[1]")]);
  const Plant a = grow(by_curve), b = grow(by_length);
  ASSERT_EQ(a.stems.path_key, b.stems.path_key);
  for (std::size_t knot = 0; knot < a.knots.size(); ++knot)
    EXPECT_LT(length(a.knots.point_m[knot] - b.knots.point_m[knot]), 1e-4f);
}

TEST(DensityAlong, KeepsTheCountAndMovesStemsAsItsIntegralSays) {
  expect_spread_by_hump(grow_with(plain_tree(), "density_along[1]", kHump));
}

TEST(DensityAlong, KeepsTheCountOnATrunkOfManySegments) {
  ParameterValues values = plain_tree();
  set(values, "curve_res[0]", 7);
  const std::size_t before = grow(values).stems.size();
  for (const std::vector<double>& density : {kHump, {0, 0, 1, 1}, {1, 0, 0, 1}, {5, 5, 0, 0}}) {
    set_along(values, "density_along[1]", density);
    EXPECT_NEAR(static_cast<double>(grow(values).stems.size()), static_cast<double>(before), 1);
  }
}

TEST(DensityAlong, BearsNothingWhereItIsZero) {
  ParameterValues values = plain_tree();
  set(values, "curve_res[0]", 7);
  set_along(values, "density_along[1]", {0, 0, 0, 0, 0, 1, 1});
  const Plant plant = grow(values);
  for (std::size_t stem = 1; stem < plant.stems.size(); ++stem)
    EXPECT_GT(above_base(base(plant, stem).z), 0.25) << stem;
}

TEST(DensityAlong, SpreadsWhorlsAndOppositeBranches) {
  for (const double branch_dist : {1.0, 3.0}) {
    ParameterValues values = plain_tree();
    set(values, "branch_dist[1]", branch_dist);
    SCOPED_TRACE(branch_dist);
    expect_spread_by_hump(grow_with(values, "density_along[1]", kHump));
  }
}

TEST(DownAngleAlong, IsAddedByPlace) {
  const std::vector<double> offsets{-30, 0, 40, 10};
  const auto [before, after] = grow_with(plain_tree(), "down_angle_along[1]", offsets);
  ASSERT_EQ(before.stems.path_key, after.stems.path_key);
  const auto angle_deg = [](const Plant& plant, std::size_t stem) {
    return degrees(std::acos(heading(plant, stem).z));
  };
  for (std::size_t stem = 1; stem < before.stems.size(); ++stem) {
    EXPECT_EQ(base(before, stem), base(after, stem));
    EXPECT_NEAR(angle_deg(after, stem) - angle_deg(before, stem),
                curve_value(make_curve(offsets), above_base(base(before, stem).z)), 0.02)
        << stem;
  }
}

/// What turns a trunk of six segments at its five inner ends.
double sum_at_ends(const std::vector<double>& numbers) {
  double sum = 0;
  for (int at = 1; at < 6; ++at) sum += curve_value(make_curve(numbers), at / 6.0);
  return sum;
}

ParameterValues six_segments() {
  ParameterValues values = plain_tree();
  set(values, "levels", 1);
  set(values, "curve_res[0]", 6);
  return values;
}

TEST(CurveAlong, IsAFactorOnTheBendOfEachSegment) {
  ParameterValues values = six_segments();
  set(values, "curve[0]", 72);
  set_along(values, "curve_along[0]", kHump);
  EXPECT_NEAR(degrees(std::acos(last_heading(grow(values)).z)), 12 * sum_at_ends(kHump), 0.02);
}

TEST(CurveAlong, IsAFactorOnTheSecondHalfAndOnWhatIsRandom) {
  ParameterValues values = six_segments();
  set(values, "curve[0]", 40);
  set(values, "curve_back[0]", -60);
  set(values, "curve_v[0]", 50);
  ParameterValues half = values;
  for (const char* name : {"curve[0]", "curve_back[0]", "curve_v[0]"}) half[table().index_of(name)] /= 2;
  set_along(values, "curve_along[0]", {0.5});
  const Plant by_curve = grow(values), by_parameters = grow(half);
  for (std::size_t knot = 0; knot < by_curve.knots.size(); ++knot)
    EXPECT_LT(length(by_curve.knots.point_m[knot] - by_parameters.knots.point_m[knot]), 1e-4f);
}

TEST(BendAlong, BendsAddUpToTheSide) {
  const std::vector<double> bends{10, 80, -20, 30};
  ParameterValues values = six_segments();
  set_along(values, "bend_along[0]", bends);
  const Plant plant = grow(values);
  EXPECT_NEAR(degrees(std::acos(last_heading(plant).z)), sum_at_ends(bends) / 6, 0.02);
  ParameterValues forward = six_segments();
  set(forward, "curve[0]", 60);
  const Vec3 to_side = tip(plant, 0), ahead = tip(grow(forward), 0);
  EXPECT_NEAR(to_side.x * ahead.x + to_side.y * ahead.y, 0, 1e-3) << "sideways is across the bend of curve";
}

TEST(RadiusAlong, IsAFactorOnRadiiAndMovesNothing) {
  ParameterValues values = table().defaults();
  set(values, "levels", 1);
  const auto [before, after] = grow_with(values, "radius_along[0]", kHump);
  ASSERT_EQ(before.knots.point_m, after.knots.point_m);
  for (std::size_t knot = 0; knot + 1 < before.knots.size(); ++knot) {
    const double z = static_cast<double>(knot) / static_cast<double>(before.knots.size() - 1);
    EXPECT_NEAR(after.knots.radius_m[knot] / before.knots.radius_m[knot], hump_at(z), 1e-4) << knot;
  }
}

TEST(LeafScaleAlong, ScalesLeavesByTheirPlaceAndMovesNone) {
  const auto [before, after] = grow_with(leafy_trunk(), "leaf_scale_along", kHump);
  ASSERT_EQ(before.leaves.position_m, after.leaves.position_m);
  ASSERT_GT(before.leaves.size(), 100u);
  for (std::size_t leaf = 0; leaf < before.leaves.size(); ++leaf) {
    const double factor = hump_at(above_base(before.leaves.position_m[leaf].z));
    EXPECT_NEAR(after.leaves.length_m[leaf] / before.leaves.length_m[leaf], factor, 1e-4) << leaf;
    EXPECT_NEAR(after.leaves.width_m[leaf] / before.leaves.width_m[leaf], factor, 1e-4) << leaf;
  }
}

TEST(LeafDensityAlong, KeepsTheCountAndMovesLeavesAsItsIntegralSays) {
  const auto [before, after] = grow_with(leafy_trunk(), "leaf_density_along", kHump);
  ASSERT_EQ(before.leaves.size(), after.leaves.size());
  for (std::size_t leaf = 0; leaf < before.leaves.size(); ++leaf)
    EXPECT_NEAR(share_below(kHump, above_base(after.leaves.position_m[leaf].z)),
                above_base(before.leaves.position_m[leaf].z), 2e-3)
        << leaf;
}

/// The knots of stems of lower levels.
std::vector<Vec3> knots_below(const Plant& plant, int level) {
  std::vector<Vec3> points;
  for (std::size_t stem = 0; stem < plant.stems.size(); ++stem)
    if (plant.stems.level[stem] < level)
      points.insert(points.end(), plant.knots.point_m.begin() + plant.stems.first_knot[stem],
                    plant.knots.point_m.begin() + plant.stems.first_knot[stem + 1]);
  return points;
}

bool same(const Plant& a, const Plant& b) {
  return a.knots.point_m == b.knots.point_m && a.knots.radius_m == b.knots.radius_m &&
         a.leaves.position_m == b.leaves.position_m && a.leaves.axis == b.leaves.axis &&
         a.leaves.length_m == b.leaves.length_m;
}

TEST(Curves, ChangeTheirLevelAndNoneBelowIt) {
  const ParameterValues aspen = table().defaults();
  const Plant before = grow(aspen);
  for (const CurveInfo& curve : table().curves) {
    ParameterValues values = aspen;
    for (std::size_t i = 0; i < kCurveRows; ++i) values[curve.first_row + i] += i * 0.1;
    const Plant after = grow(values);
    const int level = curve.level < 0 ? 3 : curve.level;
    EXPECT_EQ(knots_below(before, level), knots_below(after, level)) << curve.full_name();
    const bool means = level < 3 || curve.level < 0 || curve.name == "down_angle_along";
    EXPECT_EQ(same(before, after), !means) << curve.full_name();
  }
}

/// Leaves of a twig and stems of a branch are placed by vectors, those of a trunk one by one.
TEST(Curves, AreTheSameInVectorsAndOneByOne) {
  ParameterValues values = table().defaults();
  for (const CurveInfo& curve : table().curves)
    for (std::size_t i = 0; i < kCurveRows; ++i) values[curve.first_row + i] += i * 0.15;
  const WeberPennParameters p = weber_penn_parameters(values);
  Plant many, one;
  ASSERT_TRUE(grow_tree(p, 1, {}, many, Lanes::many).grown);
  ASSERT_TRUE(grow_tree(p, 1, {}, one, Lanes::one).grown);
  ASSERT_EQ(many.stems.path_key, one.stems.path_key);
  ASSERT_EQ(many.leaves.size(), one.leaves.size());
  for (std::size_t knot = 0; knot < one.knots.size(); ++knot) {
    ASSERT_LT(length(many.knots.point_m[knot] - one.knots.point_m[knot]), 2e-3f);
    ASSERT_NEAR(many.knots.radius_m[knot], one.knots.radius_m[knot], 1e-5f);
  }
  for (std::size_t leaf = 0; leaf < one.leaves.size(); ++leaf) {
    ASSERT_LT(length(many.leaves.position_m[leaf] - one.leaves.position_m[leaf]), 2e-3f);
    ASSERT_NEAR(many.leaves.length_m[leaf], one.leaves.length_m[leaf], 1e-5f);
  }
}

}  // namespace
}  // namespace espalier::along_stems
