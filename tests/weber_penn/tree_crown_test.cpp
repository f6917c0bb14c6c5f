// The crown envelope of a tree: stems cut by it, given their lengths by it, trained along it.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include <espalier/models/preset.h>
#include <espalier/overrides/change_graph.h>
#include <espalier/overrides/overrides.h>
#include <espalier/weber_penn/estimate.h>
#include <espalier/weber_penn/model.h>
#include <espalier/weber_penn/tree_crown.h>

namespace espalier {
namespace {

ParameterValues but_with(ParameterValues values, const std::vector<std::pair<std::string, double>>& changes) {
  for (const auto& [name, value] : changes) values[weber_penn_table().index_of(name)] = value;
  return values;
}

/// Two levels, without leaves, in a lopsided crown.
ParameterValues in_crown(const std::string& species, CrownUse use) {
  return but_with(load_preset(species).values, {{"crown_use", static_cast<double>(use)},
                                                {"levels", 2},
                                                {"leaf_blos_num", 0},
                                                {"crown_top", 1.1},
                                                {"crown_bottom", 0.1},
                                                {"crown_radius_left", 0.5},
                                                {"crown_radius_right", 0.2},
                                                {"crown_rim_left", 0.3},
                                                {"crown_shape_above", 1.4}});
}

Plant tree_of(const ParameterValues& values, Seed seed = 1, const GrowthSettings& settings = {}) {
  Plant plant;
  EXPECT_TRUE(weber_penn_model().generate(values, seed, settings, plant).grown);
  return plant;
}

CrownEnvelope crown_of(const ParameterValues& values, const Plant& plant) {
  return CrownEnvelope(crown_shape(weber_penn_parameters(values), plant.tree_scale_m));
}

struct StemEnds {
  Vec3 base, tip;
};

std::vector<StemEnds> laterals(const Plant& plant) {
  std::vector<StemEnds> ends;
  for (std::size_t stem = 0; stem < plant.stems.size(); ++stem)
    if (plant.stems.level[stem] == 1)
      ends.push_back({plant.knots.point_m[plant.stems.first_knot[stem]],
                      plant.knots.point_m[plant.stems.first_knot[stem + 1] - 1]});
  return ends;
}

/// Of the first knots of level 0.
std::vector<Vec3> trunk_of(const Plant& plant) {
  return {plant.knots.point_m.begin(), plant.knots.point_m.begin() + plant.stems.first_knot[1]};
}

TEST(TreeCrown, TipsOfLateralsAreOnTheEnvelopeThatGivesTheirLengths) {
  for (const char* species : {"quaking_aspen", "silver_birch", "small_pine", "black_tupelo"}) {
    const ParameterValues values = but_with(in_crown(species, CrownUse::length), {{"seg_splits[1]", 0}});
    const Plant plant = tree_of(values);
    const CrownEnvelope crown = crown_of(values, plant);
    const std::vector<StemEnds> stems = laterals(plant);
    EXPECT_GT(stems.size(), 20u) << species;
    for (const StemEnds& stem : stems)
      EXPECT_LT(std::fabs(crown.signed_distance_m(stem.tip)), 0.01f * length(stem.tip - stem.base))
          << species;
  }
}

TEST(TreeCrown, WhereLateralsSplitNoTipLeavesTheEnvelopeAndOneOfEachIsOnIt) {
  const ParameterValues values = but_with(in_crown("black_oak", CrownUse::length), {{"seg_splits[1]", 0.5}});
  const Plant plant = tree_of(values);
  const CrownEnvelope crown = crown_of(values, plant);
  std::map<std::pair<std::int32_t, std::uint32_t>, float> outermost_m;  // by trunk and child
  for (std::size_t stem = 0; stem < plant.stems.size(); ++stem) {
    if (plant.stems.level[stem] != 1) continue;
    const float outside_m =
        crown.signed_distance_m(plant.knots.point_m[plant.stems.first_knot[stem + 1] - 1]);
    EXPECT_LT(outside_m, 0.02f);
    std::size_t first = stem;
    while (plant.stems.origin[first] != plant.stems.parent[first])
      first = static_cast<std::size_t>(plant.stems.origin[first]);
    const std::pair key{plant.stems.parent[first], plant.stems.child_index[first]};
    outermost_m[key] = std::max(outermost_m.contains(key) ? outermost_m[key] : -100.f, outside_m);
  }
  EXPECT_GT(outermost_m.size(), 20u);
  for (const auto& [key, outside_m] : outermost_m) EXPECT_NEAR(outside_m, 0, 0.02) << key.second;
}

/// Boudon et al. 2003, Fig. 7.
TEST(TreeCrown, AnotherCrownChangesTheLengthsOfLateralsAndNothingElseOfThem) {
  const ParameterValues one = but_with(in_crown("quaking_aspen", CrownUse::length), {{"ratio", 0.001}});
  const ParameterValues other =
      but_with(one, {{"crown_radius_left", 0.25}, {"crown_top", 1.3}, {"crown_shape_above", 3}});
  const Plant a = tree_of(one), b = tree_of(other);
  EXPECT_EQ(trunk_of(a), trunk_of(b));
  EXPECT_EQ(a.stems.path_key, b.stems.path_key);
  const std::vector<StemEnds> of_a = laterals(a), of_b = laterals(b);
  int changed = 0;
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    const Vec3 along_a = of_a[i].tip - of_a[i].base, along_b = of_b[i].tip - of_b[i].base;
    EXPECT_LT(length(of_a[i].base - of_b[i].base), 0.02f);  // but for the radius, that goes with the length
    EXPECT_GT(dot(normalized(along_a), normalized(along_b)), 0.99999f);
    changed += std::fabs(length(along_a) - length(along_b)) > 0.05f * length(along_a);
  }
  EXPECT_GT(changed, 20);
}

TEST(TreeCrown, WhereItIsOffItsOtherNumbersSayNothing) {
  const ParameterValues values = load_preset("quaking_aspen").values;
  const Plant plain = tree_of(values),
              other = tree_of(but_with(values, {{"crown_top", 0.5}, {"crown_radius_left", 0.05}}));
  EXPECT_EQ(plain.knots.point_m, other.knots.point_m);
  EXPECT_EQ(plain.leaves.position_m, other.leaves.position_m);
}

TEST(TreeCrown, EachNumberOfTheEnvelopeMovesTips) {
  const ParameterValues values = in_crown("quaking_aspen", CrownUse::length);
  const Plant plain = tree_of(values);
  for (const ParameterInfo& row : weber_penn_table().rows)
    if (row.part_of == "crown_use" && row.name != "crown_use") {
      const double value = values[weber_penn_table().index_of(row.name)];
      EXPECT_NE(tree_of(but_with(values, {{row.name, 0.7 * value + 0.1}})).knots.point_m, plain.knots.point_m)
          << row.name;
    }
}

TEST(TreeCrown, CutStemsStayInsideAndTheTrunkStandsBelow) {
  for (const CrownUse use : {CrownUse::cut, CrownUse::train}) {
    const ParameterValues values = but_with(in_crown("quaking_aspen", use), {{"levels", 3},
                                                                             {"crown_bottom", 0.5},
                                                                             {"base_size[0]", 0.1},
                                                                             {"crown_top", 0.8},
                                                                             {"leaf_blos_num", 20}});
    const Plant plant = tree_of(values);
    const CrownEnvelope crown = crown_of(values, plant);
    EXPECT_GT(laterals(plant).size(), 10u);
    for (std::size_t stem = 0; stem < plant.stems.size(); ++stem)
      for (std::size_t k = plant.stems.first_knot[stem] + 1; k < plant.stems.first_knot[stem + 1]; ++k) {
        const Vec3 point = plant.knots.point_m[k];
        EXPECT_TRUE(
            crown.contains(point) ||
            (plant.stems.level[stem] == 0 && point.z < crown.shape().top_m.z && crown.is_under_top(point)) ||
            (plant.stems.level[stem] == 0 && point.z <= crown.shape().bottom_m.z));
      }
    for (const Vec3 leaf : use == CrownUse::train ? plant.leaves.position_m : std::vector<Vec3>())
      EXPECT_LT(crown.signed_distance_m(leaf), 0.1f);
    const std::vector<Vec3> trunk = trunk_of(plant);
    EXPECT_GT(trunk.back().z, crown.shape().bottom_m.z);  // up into the crown
    EXPECT_LT(trunk.back().z, crown.shape().top_m.z);     // and no further
  }
}

TEST(TreeCrown, TrainingKeepsMoreOfTheBranchesThanCutting) {
  const auto length_m = [](CrownUse use) {
    float sum = 0;
    const auto values = but_with(in_crown("quaking_aspen", use), {{"crown_radius_left", 0.1},
                                                                  {"crown_radius_right", 0.1},
                                                                  {"crown_radius_back", 0.1},
                                                                  {"crown_radius_front", 0.1}});
    for (const StemEnds& stem : laterals(tree_of(values))) sum += length(stem.tip - stem.base);
    return sum;
  };
  EXPECT_GT(length_m(CrownUse::train), 1.1f * length_m(CrownUse::cut));
}

TEST(TreeCrown, TakesThePlaceOfTheEnvelopeOfThePruneRows) {
  const ParameterValues values = in_crown("quaking_aspen", CrownUse::length),
                        narrow = but_with(values, {{"prune_ratio", 1}, {"prune_width", 0.01}});
  EXPECT_EQ(tree_of(values).knots.point_m, tree_of(narrow).knots.point_m);
}

TEST(TreeCrown, AVolumeThatIsGivenCutsAsWell) {
  const auto volume = make_cylinder({0, 0, 0}, 0.7f, 60);
  const ParameterValues values = in_crown("quaking_aspen", CrownUse::length);
  for (const StemEnds& stem : laterals(tree_of(values, 1, {.prune_to = volume.get()})))
    EXPECT_TRUE(volume->contains(stem.tip));
}

TEST(TreeCrown, ABranchsOwnLengthIsRelativeToItsReach) {
  const ParameterValues values = in_crown("quaking_aspen", CrownUse::length);
  Overrides overrides;
  for (std::uint32_t child = 0; child < 100; ++child)
    set_override(overrides.at({0, child}).set, {Quantity::length, Relation::factor, 0.5, true});
  const ChangeGraph changes(overrides);
  const std::vector<StemEnds> whole = laterals(tree_of(values)),
                              half = laterals(tree_of(values, 1, {.changes = &changes}));
  ASSERT_EQ(whole.size(), half.size());
  for (std::size_t i = 0; i < whole.size(); ++i)
    EXPECT_NEAR(length(half[i].tip - half[i].base) / length(whole[i].tip - whole[i].base), 0.5, 0.02);
}

RC_GTEST_PROP(TreeCrown, AllValuesOfItsRowsMakeAnEnvelope, ()) {
  ParameterValues values = weber_penn_table().defaults();
  for (std::size_t row = 0; row < values.size(); ++row) {
    const ParameterInfo& info = weber_penn_table().rows[row];
    if (info.part_of != "crown_use" || info.name == "crown_use") continue;
    const int part = *rc::gen::element(0, 1000, *rc::gen::inRange(0, 1001));
    values[row] = std::lerp(info.lower, info.upper, part / 1000.0);
  }
  for (const float scale_m : {0.05f, 12.f, 400.f}) {
    const CrownEnvelope crown(crown_shape(weber_penn_parameters(values), scale_m));
    RC_ASSERT(crown.shape().top_m.z > crown.shape().bottom_m.z);
  }
}

TEST(TreeCrown, TheEstimateOfStemsFollowsTheCrown) {
  for (const double radius : {0.15, 0.3, 0.6}) {
    ParameterValues values = but_with(load_preset("quaking_aspen").values, {{"crown_use", 2}});
    for (const char* side : {"right", "back", "left", "front"})
      values = but_with(values, {{std::string("crown_radius_") + side, radius}});
    const Plant plant = tree_of(values);
    const double expected = estimate_growth(weber_penn_parameters(values)).stems;
    EXPECT_GT(static_cast<double>(plant.stems.size()), 0.6 * expected) << radius;
    EXPECT_LT(static_cast<double>(plant.stems.size()), 1.6 * expected) << radius;
  }
}

/// Rows of crowns, each anywhere in its range of search.
RC_GTEST_PROP(TreeCrown, RowsThatAreSetFromAnEnvelopeMakeIt, ()) {
  const ParameterTable& table = weber_penn_table();
  ParameterValues values = table.defaults(), read_back = table.defaults();
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const ParameterInfo& info = table.rows[row];
    if (info.name.rfind("crown_", 0) != 0 || info.name == "crown_use") continue;
    const double share = 1e-3 * *rc::gen::inRange(0, 1001);
    values[row] = std::lerp(info.search_lower, info.search_upper, share);
  }
  const auto scale_m = 0.1f * static_cast<float>(*rc::gen::inRange(5, 400));
  read_back[table.index_of("g_scale")] = scale_m;
  set_crown_rows(crown_shape(weber_penn_parameters(values), scale_m), read_back);
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    if (table.rows[row].name != "g_scale" && table.rows[row].name != "crown_use")
      RC_ASSERT(std::fabs(read_back[row] - values[row]) < 2e-5);
  RC_ASSERT(read_back[table.index_of("crown_use")] == table.defaults()[table.index_of("crown_use")]);
}

TEST(TreeCrown, RowsThatAreSetFromAnEnvelopeAreValid) {
  const ParameterTable& table = weber_penn_table();
  ParameterValues values = table.defaults();
  set_crown_rows({.top_m = {9, 0, 1000}, .bottom_m = {0, 0, 999}, .radius_m = {10, 1000, 1e-3f, 1}}, values);
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    EXPECT_TRUE(is_valid_value(table.rows[row], values[row])) << table.rows[row].full_name();
}

}  // namespace
}  // namespace espalier
