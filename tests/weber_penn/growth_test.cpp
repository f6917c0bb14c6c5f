// Laws of Weber–Penn growth: what must hold for all parameters, and what each parameter does.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include <espalier/environment/volume.h>
#include <espalier/weber_penn/model.h>
#include <espalier/weber_penn/scalar/stem.h>
#include <espalier/weber_penn/table/parameters.h>

namespace espalier {
namespace {

const ParameterTable& table() { return weber_penn_table(); }

ParameterValues aspen() { return table().defaults(); }

void set(ParameterValues& values, const char* name, double value) { values[table().index_of(name)] = value; }

Plant grow(const ParameterValues& values, Seed seed = 1, const GrowthSettings& settings = {}) {
  Plant plant;
  EXPECT_TRUE(weber_penn_model().generate(values, seed, settings, plant).grown);
  return plant;
}

std::size_t stems_of_level(const Plant& plant, int level) {
  return std::count(plant.stems.level.begin(), plant.stems.level.end(), level);
}

Vec3 tip(const Plant& plant, std::size_t stem) {
  return plant.knots.point_m[plant.stems.first_knot[stem + 1] - 1];
}

bool same_plant(const Plant& a, const Plant& b) {
  return a.knots.point_m == b.knots.point_m && a.knots.radius_m == b.knots.radius_m &&
         a.stems.path_key == b.stems.path_key && a.leaves.position_m == b.leaves.position_m &&
         a.leaves.axis == b.leaves.axis && a.leaves.length_m == b.leaves.length_m;
}

/// A tree without leaves or twigs, whose trunk is a straight vertical stem.
ParameterValues bare_trunk() {
  ParameterValues values = aspen();
  for (const char* name : {"g_scale_v", "curve_v[0]", "flare", "leaf_blos_num"}) set(values, name, 0);
  set(values, "levels", 1);
  return values;
}

/// Values drawn within the table's search ranges, small enough to grow quickly.
rc::Gen<ParameterValues> any_values() {
  return rc::gen::exec([] {
    ParameterValues values = aspen();
    for (std::size_t row = 0; row < values.size(); ++row) {
      const ParameterInfo& info = table().rows[row];
      const double part = *rc::gen::inRange(0, 1001) / 1000.0;
      values[row] = info.search_lower + part * (info.search_upper - info.search_lower);
      if (info.scale == Scale::integer || info.scale == Scale::choice) values[row] = std::round(values[row]);
    }
    set(values, "branches[0]", *rc::gen::inRange(1, 4));
    set(values, "branches[1]", *rc::gen::inRange(-5, 20));
    set(values, "branches[2]", *rc::gen::inRange(-5, 10));
    set(values, "branches[3]", *rc::gen::inRange(-3, 5));
    set(values, "leaf_blos_num", *rc::gen::inRange(-10, 10));
    set(values, "curve_v[1]", *rc::gen::inRange(-90, 200));
    return values;
  });
}

bool is_finite(Vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

RC_GTEST_PROP(Growth, AnyValidParametersGiveAFinitePlantOrARefusal, ()) {
  const ParameterValues values = *any_values();
  Plant plant;
  const GrowthResult result =
      weber_penn_model().generate(values, *rc::gen::inRange(0, 99), {{20'000, 100'000}}, plant);
  if (!result.grown) RC_ASSERT(result.over_budget_factor > 1);
  RC_ASSERT(std::all_of(plant.knots.point_m.begin(), plant.knots.point_m.end(), is_finite));
  RC_ASSERT(std::all_of(plant.knots.handle_in_m.begin(), plant.knots.handle_in_m.end(), is_finite));
  RC_ASSERT(std::all_of(plant.knots.radius_m.begin(), plant.knots.radius_m.end(),
                        [](float r) { return std::isfinite(r) && r >= 0; }));
  for (std::size_t leaf = 0; leaf < plant.leaves.size(); ++leaf) {
    RC_ASSERT(std::fabs(length(plant.leaves.axis[leaf]) - 1) < 1e-3f);
    RC_ASSERT(std::fabs(dot(plant.leaves.axis[leaf], plant.leaves.side[leaf])) < 1e-3f);
  }
}

RC_GTEST_PROP(Growth, TheSameSeedGivesTheSameBits, ()) {
  const ParameterValues values = *any_values();
  const Seed seed = *rc::gen::inRange(0, 1000);
  Plant first, second;
  weber_penn_model().generate(values, seed, {}, first);
  weber_penn_model().generate(values, seed + 1, {}, second);  // its memory is reused below
  weber_penn_model().generate(values, seed, {}, second);
  RC_ASSERT(same_plant(first, second));
}

RC_GTEST_PROP(Growth, ParentsComeBeforeTheirChildren, ()) {
  Plant plant;
  weber_penn_model().generate(*any_values(), 1, {{20'000, 100'000}}, plant);
  for (std::size_t stem = 0; stem < plant.stems.size(); ++stem) {
    RC_ASSERT(plant.stems.parent[stem] < static_cast<int>(stem));
    RC_ASSERT(plant.stems.first_knot[stem + 1] - plant.stems.first_knot[stem] >= 2u);
    const int parent = plant.stems.parent[stem];
    if (parent >= 0) RC_ASSERT(plant.stems.level[parent] + 1 == plant.stems.level[stem]);
  }
}

TEST(Growth, AnotherSeedGivesAnotherTree) { EXPECT_FALSE(same_plant(grow(aspen(), 1), grow(aspen(), 2))); }

TEST(Growth, ASmallChangeOfOneParameterMovesTheTreeALittle) {
  ParameterValues changed = aspen();
  set(changed, "curve[1]", changed[table().index_of("curve[1]")] + 0.01);
  const Plant before = grow(aspen()), after = grow(changed);
  ASSERT_EQ(before.stems.path_key, after.stems.path_key);
  for (std::size_t knot = 0; knot < before.knots.size(); ++knot)
    ASSERT_LT(length(before.knots.point_m[knot] - after.knots.point_m[knot]), 0.01f);
}

TEST(Growth, ScalingAllLengthsScalesTheTree) {
  ParameterValues doubled = aspen();
  for (const char* name : {"g_scale", "g_scale_v", "leaf_scale"}) {
    const std::size_t row = table().index_of(name);
    doubled[row] *= 2;
  }
  const Plant small = grow(aspen()), large = grow(doubled);
  ASSERT_EQ(small.leaves.size(), large.leaves.size());
  for (std::size_t leaf = 0; leaf < small.leaves.size(); ++leaf) {
    ASSERT_NEAR(large.leaves.length_m[leaf], 2 * small.leaves.length_m[leaf], 1e-4f);
    // Within the thickness of twigs, whose radius has a floor of 5 mm that does not scale.
    ASSERT_LT(length(large.leaves.position_m[leaf] - 2 * small.leaves.position_m[leaf]), 0.12f);
  }
}

TEST(Growth, ABareTrunkIsAsHighAsItsScaleAndAsThickAsItsRatio) {
  const Plant plant = grow(bare_trunk());
  ASSERT_EQ(plant.stems.size(), 1u);
  EXPECT_NEAR(tip(plant, 0).z, 13, 1e-3);
  EXPECT_NEAR(plant.knots.radius_m.front(), 13 * 0.015, 1e-5);
}

TEST(Growth, RadiusModScalesTheTrunksRadius) {
  ParameterValues values = bare_trunk();
  set(values, "radius_mod[0]", 0.5);
  EXPECT_NEAR(grow(values).knots.radius_m.front(), 0.5 * 13 * 0.015, 1e-5);
}

/// On a cylinder, where no stem is as thick as its parent; but for those as thin as a stem gets.
TEST(Growth, RadiusModScalesTheRadiusOfItsLevel) {
  ParameterValues values = bare_trunk();
  set(values, "levels", 2);
  set(values, "taper[0]", 0);
  const Plant whole = grow(values);
  set(values, "radius_mod[1]", 0.5);
  const Plant half = grow(values);
  ASSERT_EQ(whole.stems.path_key, half.stems.path_key);
  EXPECT_EQ(half.knots.radius_m.front(), whole.knots.radius_m.front());
  int halved = 0;
  for (std::size_t stem = 1; stem < whole.stems.size(); ++stem) {
    const float before_m = whole.knots.radius_m[whole.stems.first_knot[stem]],
                after_m = half.knots.radius_m[half.stems.first_knot[stem]];
    if (after_m > 0.0051f) {
      EXPECT_NEAR(after_m / before_m, 0.5, 1e-3) << stem;
      ++halved;
    }
  }
  EXPECT_GT(halved, 10);
}

TEST(Growth, NegativeLeafNumbersAreAFanOfThatManyAtEachTip) {
  ParameterValues values = aspen();
  set(values, "leaf_blos_num", -7);
  const Plant plant = grow(values);
  EXPECT_EQ(plant.leaves.size(), 7 * stems_of_level(plant, 2));
}

TEST(Growth, BlossomRateIsTheShareOfBlossom) {
  ParameterValues values = aspen();
  set(values, "blossom_rate", 0.35);
  const Plant plant = grow(values);
  const double blossom = std::count(plant.leaves.kind.begin(), plant.leaves.kind.end(), LeafKind::blossom);
  EXPECT_NEAR(blossom / plant.leaves.size(), 0.35, 0.01);
}

TEST(Growth, TrunksStandAtLeastTwoAndAHalfRadiiApart) {
  ParameterValues values = aspen();
  set(values, "branches[0]", 30);
  set(values, "levels", 1);
  set(values, "ratio", 0.005);
  const Plant plant = grow(values);
  ASSERT_EQ(plant.stems.size(), 30u);
  for (std::size_t a = 0; a < 30; ++a)
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_GE(length(plant.knots.point_m[plant.stems.first_knot[a]] -
                       plant.knots.point_m[plant.stems.first_knot[b]]),
                2.5f * 13 * 0.005f * 0.999f);
}

TEST(Growth, BaseSplitsCloneTheTrunk) {
  ParameterValues values = bare_trunk();
  set(values, "base_splits", 2);
  EXPECT_EQ(stems_of_level(grow(values), 0), 3u);
}

TEST(Growth, NegativeBaseSplitsAreARandomNumberUpToThatMany) {
  ParameterValues values = bare_trunk();
  set(values, "base_splits", -2);
  int seen[4] = {0, 0, 0, 0};
  for (Seed seed = 0; seed < 60; ++seed)
    ++seen[std::min<std::size_t>(3, stems_of_level(grow(values, seed), 0) - 1)];
  EXPECT_GT(seen[0], 5);
  EXPECT_GT(seen[1], 5);
  EXPECT_GT(seen[2], 5);
  EXPECT_EQ(seen[3], 0);
}

/// Stems with the same key would bend and branch alike.
TEST(Growth, NoTwoStemsShareTheirRandomNumbers) {
  ParameterValues values = aspen();
  set(values, "base_splits", 3);
  set(values, "seg_splits[1]", 0.8);
  Plant plant = grow(values);
  std::vector<std::uint64_t>& keys = plant.stems.path_key;
  ASSERT_GT(keys.size(), 100u);
  std::sort(keys.begin(), keys.end());
  EXPECT_EQ(std::adjacent_find(keys.begin(), keys.end()), keys.end());
}

TEST(Growth, FlatSplitsStayInThePlaneOfTheStem) {
  ParameterValues values = bare_trunk();
  set(values, "base_splits", 1);
  set(values, "split_angle[0]", -60);
  set(values, "split_angle_v[0]", 0);
  const Plant plant = grow(values);
  ASSERT_EQ(plant.stems.size(), 2u);
  const Vec3 a = normalized(tip(plant, 0)), b = normalized(tip(plant, 1));
  EXPECT_NEAR(dot(cross(a, b), Vec3{0, 0, 1}), 0, 1e-4);  // the plane of both holds the vertical trunk
}

TEST(Growth, LateralTropismBendsAllLevelsTowardsIt) {
  ParameterValues values = aspen();
  set(values, "tropism_x", 3);
  EXPECT_GT(tip(grow(values), 0).x, tip(grow(aspen()), 0).x + 1);
}

TEST(Growth, VerticalTropismLeavesTheTrunkAlone) {
  ParameterValues values = aspen();
  set(values, "tropism_z", -5);
  EXPECT_EQ(tip(grow(values), 0), tip(grow(aspen()), 0));
}

TEST(Growth, AHelicalTrunkRisesByItsLengthAndWindsAboutItsAxis) {
  ParameterValues values = bare_trunk();
  set(values, "curve_v[0]", -40);
  set(values, "curve_res[0]", 8);
  const Plant plant = grow(values);
  EXPECT_NEAR(tip(plant, 0).z, 13, 13 * 0.21);  // pitch varies by a fifth
  float turns = 0;
  for (std::size_t knot = 1; knot < plant.knots.size(); ++knot) {
    const Vec3 a = plant.knots.handle_out_m[knot - 1] - plant.knots.point_m[knot - 1];
    const Vec3 b = plant.knots.handle_out_m[knot] - plant.knots.point_m[knot];
    turns += std::fabs(std::remainder(std::atan2(b.y, b.x) - std::atan2(a.y, a.x), 6.2831853f)) / 6.2831853f;
  }
  EXPECT_NEAR(turns, 4, 0.6);  // eight half turns
}

TEST(Growth, OppositeBranchesShareTheirHeight) {
  ParameterValues values = bare_trunk();
  set(values, "levels", 2);
  set(values, "branch_dist[1]", 1);
  set(values, "rotate[1]", 180);
  const Plant plant = grow(values);
  ASSERT_GT(plant.stems.size(), 20u);
  int pairs = 0;
  for (std::size_t stem = 2; stem < plant.stems.size(); ++stem) {
    const float below = plant.knots.point_m[plant.stems.first_knot[stem - 1]].z;
    pairs += std::fabs(plant.knots.point_m[plant.stems.first_knot[stem]].z - below) < 0.02f;
  }
  EXPECT_GE(pairs, static_cast<int>(plant.stems.size()) / 2 - 4);
}

TEST(Growth, WhorlsHaveOneStemMoreThanBranchDist) {
  ParameterValues values = bare_trunk();
  set(values, "levels", 2);
  set(values, "branch_dist[1]", 3);
  const Plant plant = grow(values);
  int run = 1, whorls_of_four = 0;
  for (std::size_t stem = 2; stem < plant.stems.size(); ++stem) {
    const bool same = std::fabs(plant.knots.point_m[plant.stems.first_knot[stem]].z -
                                plant.knots.point_m[plant.stems.first_knot[stem - 1]].z) < 0.05f;
    whorls_of_four += !same && run == 4;
    run = same ? run + 1 : 1;
  }
  EXPECT_GE(whorls_of_four, 8);
}

TEST(Growth, RelaxedCountsGrowTheLastChildInProportion) {
  ParameterValues values = aspen();
  set(values, "relaxed_counts", 1);
  double last = 0;
  for (double branches = 10; branches <= 12.01; branches += 0.1) {
    set(values, "branches[1]", branches);
    double total_m = 0;
    const Plant plant = grow(values);
    for (std::size_t stem = 0; stem < plant.stems.size(); ++stem)
      if (plant.stems.level[stem] == 1)
        total_m += length(tip(plant, stem) - plant.knots.point_m[plant.stems.first_knot[stem]]);
    if (last > 0) {
      EXPECT_LT(std::fabs(total_m - last), 0.06 * last) << "at " << branches;  // whole counts jump by a tenth
    }
    last = total_m;
  }
}

TEST(Growth, PlantsOverBudgetAreRefusedBeforeTheyAreGrown) {
  ParameterValues values = aspen();
  set(values, "branches[1]", 1000);
  set(values, "branches[2]", 1000);
  Plant plant;
  const GrowthResult result = weber_penn_model().generate(values, 1, {{1000, 1000}}, plant);
  EXPECT_FALSE(result.grown);
  EXPECT_GT(result.over_budget_factor, 100);
  EXPECT_EQ(plant.stems.size(), 0u);
}

TEST(Growth, TheEstimateIsWithinAFactorOfTwo) {
  const Plant plant = grow(aspen());
  const GrowthEstimate estimate = weber_penn_model().estimate(aspen());
  EXPECT_NEAR(std::log2(estimate.stems / plant.stems.size()), 0, 1);
  EXPECT_NEAR(std::log2(estimate.leaves / plant.leaves.size()), 0, 1);
}

TEST(Pruning, NoStemLeavesTheVolumeAboveTheBase) {
  class Ball : public Volume {
   public:
    bool contains(Vec3 p) const override { return signed_distance_m(p) < 0; }
    float signed_distance_m(Vec3 p) const override { return length(p - Vec3{0, 0, 7}) - 4; }
  };
  const Ball ball;
  GrowthSettings settings;
  settings.prune_to = &ball;
  ParameterValues values = aspen();
  set(values, "seg_splits[1]", 0.8);
  set(values, "split_angle[1]", 30);
  const Plant plant = grow(values, 1, settings);
  ASSERT_GT(stems_of_level(plant, 1), 5u);
  for (std::size_t stem = 0; stem < plant.stems.size(); ++stem)
    for (auto knot = plant.stems.first_knot[stem] + 1; knot < plant.stems.first_knot[stem + 1]; ++knot)
      if (plant.stems.level[stem] > 0) {
        ASSERT_TRUE(ball.contains(plant.knots.point_m[knot])) << "stem " << stem;
      }
}

TEST(Pruning, PruneRatioLiesBetweenUnprunedAndFullyPruned) {
  ParameterValues values = aspen();
  set(values, "prune_width", 0.15);
  const auto reach_m = [&](double ratio) {
    set(values, "prune_ratio", ratio);
    const Bounds box = bounds(grow(values));
    return box.upper.x - box.lower.x;
  };
  const float none = reach_m(0), half = reach_m(0.5), full = reach_m(1);
  EXPECT_GT(none, half);
  EXPECT_GT(half, full);
}

}  // namespace
}  // namespace espalier
