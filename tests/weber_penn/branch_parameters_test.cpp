// Parameters of single branches in grown trees, and nodes of ranges: what they change, and what they leave.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include <espalier/core/curves/parameter_curves.h>
#include <espalier/models/preset.h>
#include <espalier/overrides/change_graph.h>
#include <espalier/overrides/overrides_toml.h>
#include <espalier/weber_penn/model.h>
#include <espalier/weber_penn/table/parameters.h>

namespace espalier {
namespace {

/// A stem as it grew: its curve and radii.
struct GrownStem {
  std::vector<Vec3> points;
  std::vector<float> radii;
  bool operator==(const GrownStem&) const = default;
};

struct GrownTree {
  std::map<BranchPath, GrownStem> stems;
  Plant plant;

  bool operator==(const GrownTree& other) const {
    return stems == other.stems && plant.leaves.position_m == other.plant.leaves.position_m &&
           plant.leaves.length_m == other.plant.leaves.length_m;
  }
};

Overrides overrides_of(const std::string& text) {
  const toml::table document = parse_toml(text, "tree.toml");
  Overrides overrides;
  read_overrides({document, "tree.toml"}, weber_penn_table(), overrides);
  return overrides;
}

std::string branch(const std::string& path, const std::string& says) {
  return fmt::format("[[branch]]\npath = \"{}\"\n{}\n", path, says);
}

GrownTree tree_of(const ParameterValues& values, const std::string& text) {
  const Overrides overrides = overrides_of(text);
  const ChangeGraph changes(overrides);
  GrowthSettings settings{{50'000, 300'000}};
  settings.changes = &changes;
  GrownTree tree;
  EXPECT_TRUE(weber_penn_model().generate(values, 1, settings, tree.plant).grown);
  const Plant& plant = tree.plant;
  for (std::size_t s = 0; s < plant.stems.size(); ++s) {
    GrownStem& stem = tree.stems[path_of(plant, s)];
    for (std::size_t k = plant.stems.first_knot[s]; k < plant.stems.first_knot[s + 1]; ++k) {
      stem.points.push_back(plant.knots.point_m[k]);
      stem.radii.push_back(plant.knots.radius_m[k]);
    }
  }
  return tree;
}

void set_row(ParameterValues& values, const char* name, double value) {
  values[weber_penn_table().index_of(name)] = value;
}

/// Small enough for many trees.
ParameterValues small_tree(const std::string& species) {
  ParameterValues values = load_preset(species).values;
  const ParameterTable& table = weber_penn_table();
  for (const char* count : {"branches[1]", "branches[2]", "branches[3]"}) {
    double& value = values[table.index_of(count)];
    value = std::min(value, 12.0);
  }
  set_row(values, "leaf_blos_num", 5);
  return values;
}

/// Says nothing, but has all stems grow one by one, as those beside an override do.
std::string of_nothing() { return branch("0", "tropism_x = { factor = 1 }"); }

bool begins_with(const BranchPath& path, const BranchPath& start) {
  return path.size() >= start.size() && std::equal(start.begin(), start.end(), path.begin());
}

std::string any_small_species() {
  return *rc::gen::element<std::string>("quaking_aspen", "lombardy_poplar", "palm", "acer", "small_pine");
}

/// A key and its value in TOML, of a row or curve that a trunk can have for itself.
struct AnyParameter {
  std::string key, toml;
  ParameterValues values;  ///< of a tree with it
};

AnyParameter any_parameter(const ParameterValues& of_tree) {
  const ParameterTable& table = weber_penn_table();
  AnyParameter any{"", "", of_tree};
  if (*rc::gen::inRange(0, 3) == 0) {
    const CurveInfo& curve = table.curves[*rc::gen::inRange<std::size_t>(0, table.curves.size())];
    const ParameterInfo& row = table.rows[curve.first_row];
    std::vector<double> numbers(4);
    for (double& number : numbers)
      number = std::lerp(row.search_lower, row.search_upper, *rc::gen::inRange(1, 100) / 100.0);
    set_curve(table, curve, numbers, "test", any.values);
    any.key = curve.full_name();
    any.toml = fmt::format("[{}, {}, {}, {}]", numbers[0], numbers[1], numbers[2], numbers[3]);
    return any;
  }
  const std::size_t row = *rc::gen::suchThat(
      rc::gen::inRange<std::size_t>(0, table.rows.size()),
      [&](auto i) { return table.rows[i].deepest_branch != kNoBranch && table.rows[i].point < 0; });
  const ParameterInfo& info = table.rows[row];
  const double share = *rc::gen::inRange(1, 100) / 100.0;
  double value = nearest_valid_value(info, std::lerp(info.search_lower, info.search_upper, share));
  if (info.scale == Scale::integer) value = std::round(std::clamp(value, -6.0, 12.0));
  if (info.name == "seg_splits") value = std::min(value, 0.3);  // a tree of few stems
  any.values[row] = value;
  any.key = info.full_name();
  any.toml = fmt::format("{}", value);
  return any;
}

/// Whatever growth asks for, it asks the stem it grows.
RC_GTEST_PROP(BranchParameters, OfTheTrunkAreThoseOfTheTree, ()) {
  const ParameterValues values = small_tree(any_small_species());
  const AnyParameter any = any_parameter(values);
  RC_LOG() << any.key << " = " << any.toml << "\n";
  const GrownTree by_tree = tree_of(any.values, of_nothing()),
                  by_trunk = tree_of(values, branch("0", fmt::format("\"{}\" = {}", any.key, any.toml)));
  RC_ASSERT(by_tree == by_trunk);
}

RC_GTEST_PROP(BranchParameters, ChangeNothingOutsideOfTheirBranch, ()) {
  const ParameterValues values = small_tree(any_small_species());
  const GrownTree before = tree_of(values, of_nothing());
  auto place = before.stems.begin();
  std::advance(place, *rc::gen::inRange<std::size_t>(0, before.stems.size()));
  const BranchPath path = place->first;
  RC_PRE(path.size() > 1);
  const AnyParameter any = any_parameter(values);
  const ParameterOverride entry =
      overrides_of(branch("0", fmt::format("\"{}\" = {}", any.key, any.toml))).nodes[0].set.parameters[0];
  RC_PRE(weber_penn_table().rows[entry.rows[0].row].deepest_branch >= level_of(as_pattern(path)));
  const GrownTree after =
      tree_of(values, of_nothing() + branch(to_string(path), fmt::format("\"{}\" = {}", any.key, any.toml)));
  for (const auto& [other, stem] : before.stems) {
    if (begins_with(other, path)) continue;
    RC_ASSERT(after.stems.contains(other));
    RC_ASSERT(after.stems.at(other) == stem);
  }
}

/// Of the leaves by the branch of level 1 that they are on: the mean length.
std::map<std::uint32_t, double> leaf_lengths(const GrownTree& tree) {
  const Plant& plant = tree.plant;
  std::map<std::uint32_t, std::pair<double, int>> sums;
  for (std::size_t leaf = 0; leaf < plant.leaves.size(); ++leaf) {
    double nearest = 1e9;
    std::uint32_t index = 0;
    for (const auto& [path, stem] : tree.stems)
      for (const Vec3& point : stem.points)
        if (const double away = length(point - plant.leaves.position_m[leaf]);
            path.size() > 1 && away < nearest)
          nearest = away, index = path[1];
    sums[index].first += plant.leaves.length_m[leaf];
    ++sums[index].second;
  }
  std::map<std::uint32_t, double> means;
  for (const auto& [index, sum] : sums) means[index] = sum.first / sum.second;
  return means;
}

TEST(BranchParameters, LeavesOfABranchAreAsLargeAsItSays) {
  ParameterValues values = small_tree("quaking_aspen");
  set_row(values, "levels", 2), set_row(values, "branches[1]", 6), set_row(values, "leaf_blos_num", 30);
  const auto before = leaf_lengths(tree_of(values, of_nothing())),
             after = leaf_lengths(tree_of(values, branch("0/4", "leaf_scale = { factor = 0.5 }")));
  ASSERT_TRUE(after.contains(4));
  for (const auto& [index, mean] : after)
    EXPECT_NEAR(mean / before.at(index), index == 4 ? 0.5 : 1, 0.1) << index;
}

/// The children of a branch by the mean place of their bases, from its base to its tip, and their count.
std::pair<double, int> mean_place(const GrownTree& tree, const BranchPath& of) {
  const GrownStem& stem = tree.stems.at(of);
  double sum = 0;
  int count = 0;
  for (const auto& [path, child] : tree.stems) {
    if (path.size() != of.size() + 1 || !begins_with(path, of)) continue;
    sum +=
        length(child.points.front() - stem.points.front()) / length(stem.points.back() - stem.points.front());
    ++count;
  }
  return {sum / count, count};
}

TEST(BranchParameters, ADensityOfOneBranchMovesItsChildrenAlone) {
  ParameterValues values = load_preset("quaking_aspen").values;
  for (const char* bend : {"curve[1]", "curve_v[1]", "bend_v[1]"}) set_row(values, bend, 0);
  const GrownTree before = tree_of(values, of_nothing()),
                  after = tree_of(values, of_nothing() + branch("0/20", "density_along = [0, 0, 1, 4]"));
  const auto [place_before, count_before] = mean_place(before, {0, 20});
  const auto [place_after, count_after] = mean_place(after, {0, 20});
  EXPECT_GT(place_after, place_before + 0.15);
  EXPECT_NEAR(count_after, count_before, 2);
  EXPECT_EQ(mean_place(before, {0, 21}), mean_place(after, {0, 21}));
}

TEST(BranchParameters, PrivateOnesPlaceItsChildrenAndNotTheirs) {
  const ParameterValues values = load_preset("quaking_aspen").values;
  const GrownTree before = tree_of(values, of_nothing()),
                  after = tree_of(
                      values,
                      branch("0/20", "\"taper[2]\" = 0\n\"taper[1]\" = { value = 0, private = true }")),
                  alone = tree_of(values, branch("0/20", "taper = { value = 0, private = true }"));
  const auto is_cylinder = [](const GrownTree& tree, const BranchPath& path) {
    const GrownStem& stem = tree.stems.at(path);
    return std::fabs(stem.radii.back() - stem.radii.front()) < 1e-6f;
  };
  EXPECT_FALSE(is_cylinder(before, {0, 20}));
  EXPECT_TRUE(is_cylinder(after, {0, 20}));
  EXPECT_TRUE(is_cylinder(after, {0, 20, 5}));
  EXPECT_TRUE(is_cylinder(alone, {0, 20}));
  EXPECT_FALSE(is_cylinder(alone, {0, 20, 5}));
}

TEST(BranchParameters, OfASplitLeaveItTheSegmentsOfItsStem) {
  const ParameterValues values = small_tree("acer");
  const GrownTree before = tree_of(values, of_nothing());
  const auto split = std::find_if(before.stems.begin(), before.stems.end(), [](const auto& stem) {
    return stem.first.size() == 2 && stem.first.back() >= kFirstSplit;
  });
  ASSERT_NE(split, before.stems.end()) << "an acer whose trunk does not split";
  const GrownTree after = tree_of(
      values,
      branch(to_string(split->first), "\"curve_res[0]\" = 50\n\"curve_v[0]\" = -40\n\"taper[0]\" = 0"));
  ASSERT_TRUE(after.stems.contains(split->first));
  EXPECT_EQ(after.stems.at(split->first).points, split->second.points);
  EXPECT_NE(after.stems.at(split->first).radii, split->second.radii);
  EXPECT_EQ(after.stems.at({0}), before.stems.at({0}));
}

/// Straight branches on a straight trunk, `count` to its whole length, the one at its foot left out: three at
/// .25, .5 and .75, or four at .2, .4, .6 and .8.
ParameterValues laterals(int count) {
  ParameterValues values = load_preset("quaking_aspen").values;
  for (const char* none :
       {"curve[0]", "curve_v[0]", "curve[1]", "curve_v[1]", "bend_v[1]", "tropism_x", "tropism_y",
        "tropism_z", "g_scale_v", "length_v[1]", "leaf_blos_num", "down_angle_v[1]", "flare"})
    set_row(values, none, 0);
  set_row(values, "levels", 2), set_row(values, "base_size[0]", 0.1);
  set_row(values, "curve_res[0]", 1);
  set_row(values, "branches[1]", count);
  return values;
}

/// Of each branch on the trunk, where it stands and by how many degrees it bends.
std::vector<std::pair<double, double>> bends(const GrownTree& tree) {
  std::vector<std::pair<double, double>> all;
  const float trunk_m = tree.stems.at({0}).points.back().z;
  for (const auto& [path, stem] : tree.stems) {
    if (path.size() != 2) continue;
    const Vec3 first = normalized(stem.points[1] - stem.points[0]),
               last = normalized(stem.points.back() - stem.points[stem.points.size() - 2]);
    all.emplace_back(stem.points.front().z / trunk_m,
                     std::acos(std::min(1.f, dot(first, last))) * 180 / M_PI);
  }
  std::sort(all.begin(), all.end());
  return all;
}

GrownTree with_laterals(int count, const std::string& text) {
  return tree_of(laterals(count),
                 branch("0", fmt::format("child_count = {{ value = {}, private = true }}", count)) + text);
}

/// [Boudon et al. 2003, §4 and Fig. 10]: three laterals, the lowest is curved; with one more the graph has
/// other nodes, and the curve was lost when the three came back.
TEST(Figure10, TheCurveIsBackWithTheLaterals) {
  for (const char* path : {"0/1", "0/@0.15..0.3"}) {
    const std::string text = branch(path, "curvature = { offset = 80 }");
    const GrownTree three = with_laterals(4, text), four = with_laterals(5, text),
                    back = with_laterals(4, text);
    ASSERT_EQ(bends(three).size(), 3u);
    ASSERT_EQ(bends(four).size(), 4u);
    EXPECT_GT(bends(three)[0].second, 40) << path;
    EXPECT_LT(bends(three)[1].second, 1) << path;
    EXPECT_EQ(three, back) << path;
  }
}

TEST(Figure10, ARangeOfPositionsKeepsTheCurveWhereItWasInBetween) {
  const std::string of_range = branch("0/@0.15..0.3", "curvature = { offset = 80 }"),
                    of_index = branch("0/1", "curvature = { offset = 80 }");
  for (const int count : {4, 5, 8, 12}) {
    const auto laterals_of_range = bends(with_laterals(count, of_range));
    EXPECT_EQ(laterals_of_range.size(), static_cast<std::size_t>(count - (count > 10 ? 2 : 1)));
    for (const auto& [place, bend_deg] : laterals_of_range) {
      const bool is_in_range = place > 0.14 && place < 0.31;
      EXPECT_EQ(bend_deg > 40, is_in_range) << count << " at " << place;
    }
  }
  EXPECT_GT(bends(with_laterals(8, of_index))[0].second, 40);  // at .125: the index went down the trunk
}

TEST(BranchRanges, MeanTheChildrenWithTheseIndices) {
  const ParameterValues values = small_tree("quaking_aspen");
  const GrownTree before = tree_of(values, of_nothing()),
                  after =
                      tree_of(values, branch("0/5..9", "removed = true") + branch("0/7", "removed = false"));
  for (const auto& [path, stem] : before.stems) {
    const bool is_gone = path.size() > 1 && path[1] >= 5 && path[1] <= 9 && path[1] != 7;
    EXPECT_EQ(after.stems.contains(path), !is_gone) << to_string(path);
  }
}

/// Where the model puts them, and not where an override moves them.
TEST(BranchRanges, MeanTheChildrenThatTheModelPutsThere) {
  const ParameterValues values = laterals(20);
  const std::string moves = "position = { offset = 0.5 }";
  const GrownTree before = tree_of(values, of_nothing()),
                  after = tree_of(values, branch("0/@0.3..0.42", moves));
  const float trunk_m = before.stems.at({0}).points.back().z;
  int moved = 0;
  for (const auto& [path, stem] : before.stems) {
    if (path.size() != 2) continue;
    const float place = stem.points.front().z / trunk_m,
                now = after.stems.at(path).points.front().z / trunk_m;
    const bool is_in_range = place > 0.3f && place < 0.42f;
    EXPECT_NEAR(now - place, is_in_range ? 0.5 : 0, 0.02) << place;
    moved += is_in_range;
  }
  EXPECT_GE(moved, 2);
}

RC_GTEST_PROP(BranchRanges, APartGrowsAsInTheWholePlant, ()) {
  const ParameterValues values = small_tree(any_small_species());
  const std::string text =
      branch("0/*", "down_angle = { offset = 20, private = true }\nleaf_scale = { factor = 0.5 }") +
      branch("0/@0.4..0.8", "length = { factor = 0.7 }\ntaper = 0.5") +
      branch("0/2..5/*", "curvature = { offset = 50 }");
  const GrownTree whole = tree_of(values, text);
  auto place = whole.stems.begin();
  std::advance(place, *rc::gen::inRange<std::size_t>(0, whole.stems.size()));
  const Overrides overrides = overrides_of(text);
  const ChangeGraph changes(overrides);
  const PlantPart part{place->first, true};
  GrowthSettings settings;
  settings.changes = &changes;
  settings.only_part = &part;
  Plant alone;
  RC_ASSERT(weber_penn_model().generate(values, 1, settings, alone).grown);
  RC_ASSERT(alone.stems.size() == 1);
  RC_ASSERT(alone.knots.point_m.size() == place->second.points.size());
  for (std::size_t k = 0; k < alone.knots.point_m.size(); ++k)
    RC_ASSERT(length(alone.knots.point_m[k] - place->second.points[k]) < 1e-4f);
}

TEST(BranchRanges, StemsSayWhichNodesTheyFollow) {
  const Overrides overrides = overrides_of(branch("0/6", "radius = { factor = 2 }") +
                                           branch("0/6..8", "length = 1") + branch("0/900", "length = 1"));
  const ChangeGraph changes(overrides);
  std::vector<ChangeCursor> cursors;
  GrowthSettings settings;
  settings.changes = &changes;
  settings.stem_cursors = &cursors;
  Plant plant;
  ASSERT_TRUE(weber_penn_model().generate(small_tree("quaking_aspen"), 1, settings, plant).grown);
  ASSERT_EQ(cursors.size(), plant.stems.size());
  std::map<std::uint32_t, std::vector<std::string>> paths;
  for (std::size_t stem = 0; stem < cursors.size(); ++stem)
    for (const std::uint32_t node : cursors[stem].nodes())
      paths[node].push_back(to_string(path_of(plant, stem)));
  EXPECT_EQ(paths[0], std::vector<std::string>{"0/6"});
  EXPECT_FALSE(paths.contains(1));
  EXPECT_EQ(paths[2], (std::vector<std::string>{"0/6", "0/7", "0/8"}));
}

}  // namespace
}  // namespace espalier
