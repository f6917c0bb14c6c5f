// Overrides in presets: read back as written, every bad entry refused with its line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include <espalier/core/error.h>
#include <espalier/overrides/change_graph.h>
#include <espalier/overrides/overrides_toml.h>
#include <espalier/overrides/overrides_tree.h>

#include "overrides/test_table.h"

namespace espalier {
namespace {

Overrides read(const std::string& text) {
  const toml::table document = parse_toml(text, "tree.toml");
  Overrides overrides;
  read_overrides({document, "tree.toml"}, test_table(), overrides);
  return overrides;
}

Override any_override() {
  const auto quantity = static_cast<Quantity>(*rc::gen::inRange(0, 9));
  const bool relative = static_cast<std::size_t>(quantity) < kRelativeQuantities;
  if (!relative) return {quantity, Relation::value, 1, *rc::gen::arbitrary<bool>()};
  const double number = *rc::gen::inRange(0, 1001) / 1000.0;
  return {quantity, static_cast<Relation>(*rc::gen::inRange(0, 3)), number, *rc::gen::arbitrary<bool>()};
}

std::optional<DrawnAxis> any_axis() {
  const std::size_t count = *rc::gen::element<std::size_t>(0, 3, 4, 6, 10);
  if (count == 0) return std::nullopt;
  DrawnAxis axis{{}, static_cast<AxisFrame>(*rc::gen::inRange(0, 2))};
  const auto number = [] { return *rc::gen::inRange(-1000, 1001) / 3000.0; };
  while (axis.points.size() < count) axis.points.push_back({number(), number(), number()});
  axis.points.back().z = axis.points.front().z + 1;
  return axis;
}

bool same(const std::optional<DrawnAxis>& a, const std::optional<DrawnAxis>& b) {
  if (!a || !b) return !a && !b;
  return a->points == b->points && a->frame == b->frame;
}

bool same(const OverrideSet& a, const OverrideSet& b) {
  return a.shares == b.shares && a.crown == b.crown && same(a.axis, b.axis) &&
         std::is_permutation(a.overrides.begin(), a.overrides.end(), b.overrides.begin(), b.overrides.end(),
                             [](const Override& x, const Override& y) {
                               const bool private_alike =
                                   x.is_private == y.is_private || x.quantity == Quantity::removed;
                               return x.quantity == y.quantity && x.relation == y.relation &&
                                      x.number == y.number && private_alike;
                             });
}

RC_GTEST_PROP(OverridesToml, ReadsBackTheSameBits, ()) {
  Overrides overrides;
  const int nodes = *rc::gen::inRange(0, 5);
  for (int i = 0; i < nodes; ++i) {
    OverrideSet& set = overrides.at({0, static_cast<std::uint32_t>(*rc::gen::inRange(0, 50))}).set;
    for (int k = *rc::gen::inRange(0, 4); k > 0; --k) set_override(set, any_override());
    if (*rc::gen::arbitrary<bool>())
      for (const BranchCrownNumber& each : numbers_of(set.crown.emplace()))
        *each.number =
            std::lerp(each.lower, each.upper, static_cast<float>(*rc::gen::inRange(0, 1001)) / 1000);
    set.axis = any_axis();
  }
  overrides.shared["a b"].overrides = {{Quantity::length, Relation::factor, 1.25, false}};
  const Overrides back = read(overrides_to_toml(overrides));
  RC_ASSERT(back.nodes.size() == overrides.nodes.size());
  for (std::size_t i = 0; i < back.nodes.size(); ++i) {
    RC_ASSERT(back.nodes[i].path == overrides.nodes[i].path);
    RC_ASSERT(same(back.nodes[i].set, overrides.nodes[i].set));
  }
  RC_ASSERT(same(back.shared.at("a b"), overrides.shared.at("a b")));
}

/// "-0.0" would be written as -0, a whole number, which has no sign when it is read.
TEST(OverridesToml, NoNumberIsMinusZero) {
  const std::string text =
      "[[branch]]\npath = \"0/1\"\naxis = [[-0.0, 0, 0.5], [1, -0.0, 1], [2, 0, 1]]\nrotation = { offset = "
      "-0.0 }\n"
      "crown = { rim = -0.0 }\n";
  const std::string written = overrides_to_toml(read(text));
  EXPECT_EQ(written.find("-0"), std::string::npos) << written;
  EXPECT_EQ(overrides_to_toml(read(written)), written);
}

TEST(OverridesToml, NodesStandInTheOrderOfTheirPaths) {
  const Overrides overrides =
      read("[[branch]]\npath = \"0/7\"\nlength = 1\n[[branch]]\npath = \"0/3\"\nlength = 1\n");
  ASSERT_EQ(overrides.nodes.size(), 2u);
  EXPECT_EQ(to_string(overrides.nodes[0].path), "0/3");
}

TEST(OverridesToml, NumbersOfACrownThatNameNoSideAreThoseOfAllSides) {
  const Overrides overrides = read(
      "[[branch]]\npath = \"0/7\"\ncrown = { radius_up = 0.1, radius = 0.4, rim_down = 1, shape = 3, "
      "shape_tip = 1.5 }\n");
  const BranchCrown expected{
      .radius = {0.4f, 0.1f, 0.4f, 0.4f}, .rim = {0.5f, 0.5f, 0.5f, 1}, .shape_tip = 1.5f, .shape_base = 3};
  EXPECT_EQ(overrides.nodes.at(0).set.crown, expected);
}

struct BadText {
  const char* name;
  const char* text;
  const char* message;  ///< a part of it
};

class BadOverrides : public testing::TestWithParam<BadText> {};

TEST_P(BadOverrides, AreRefusedInOneLineWithTheirPlace) {
  try {
    read(GetParam().text);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("tree.toml:"));
    EXPECT_THAT(error.what(), testing::HasSubstr(GetParam().message));
    EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n")));
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, BadOverrides,
    testing::Values(
        BadText{"NoPath", "[[branch]]\nlength = 1\n", "without a path"},
        BadText{"BadPath", "[[branch]]\npath = \"trunk\"\n", "tree.toml:2: got 'trunk'"},
        BadText{"UnknownKey", "[[branch]]\npath = \"0\"\nlenght = 1\n", "length"},
        BadText{"TwoRelations", "[[branch]]\npath = \"0\"\nlength = { factor = 1, offset = 2 }\n",
                "got 2 of"},
        BadText{"NoRelation", "[[branch]]\npath = \"0\"\nlength = { private = true }\n", "got 0 of"},
        BadText{"NegativeFactor", "[[branch]]\npath = \"0\"\nlength = { factor = -1 }\n", "got -1"},
        BadText{"NotFinite", "[[branch]]\npath = \"0\"\nlength = nan\n", "got nan"},
        BadText{"Text", "[[branch]]\npath = \"0\"\nlength = \"long\"\n", "'long'"},
        BadText{"SeedOffset", "[[branch]]\npath = \"0\"\nseed = { offset = 1 }\n", "expected a value"},
        BadText{"HalfSeed", "[[branch]]\npath = \"0\"\nseed = 1.5\n", "whole number"},
        BadText{"TrunkPosition", "[[branch]]\npath = \"0\"\nposition = 0.5\n", "has a parent"},
        BadText{"PositionBeyond", "[[branch]]\npath = \"0/1\"\nposition = 1.5\n", "from 0 to 1"},
        BadText{"CrownOfUnknownNumber", "[[branch]]\npath = \"0\"\ncrown = { radius_top = 1 }\n", "radius_"},
        BadText{"CrownOfNegativeRadius", "[[branch]]\npath = \"0\"\ncrown = { radius = -1 }\n",
                "radius: got -1, expected a number from 0.001 to 10"},
        BadText{"CrownOfNoRadius", "[[branch]]\npath = \"0\"\ncrown = { radius_up = nan }\n", "got nan"},
        BadText{"CrownWhoseRimIsBeyondItsTip", "[[branch]]\npath = \"0\"\ncrown = { rim_left = 1.2 }\n",
                "from 0 to 1"},
        BadText{"CrownOfNoShape", "[[branch]]\npath = \"0\"\ncrown = { shape = 0 }\n", "from 0.1 to 100"},
        BadText{"CrownThatIsANumber", "[[branch]]\npath = \"0\"\ncrown = 1\n", "crown"},
        BadText{"UnknownShare", "[[branch]]\npath = \"0\"\nshares = \"x\"\n", "'x'"},
        BadText{"Cycle",
                "[shared.a]\nshares = \"b\"\n[shared.b]\nshares = \"a\"\n[[branch]]\npath = \"0\"\nshares = "
                "\"a\"\n",
                "no cycle"},
        BadText{"CycleThatNoBranchShares", "[shared.a]\nshares = \"b\"\n[shared.b]\nshares = \"a\"\n",
                "no cycle"},
        BadText{"SetThatSharesItself", "[shared.a]\nshares = \"a\"\n",
                "tree.toml:2: overrides: shared set 'a'"},
        BadText{"SetThatSharesAnUnknownOne", "[shared.a]\nshares = \"x\"\n", "'x'"},
        BadText{"AxisOfOnePoint", "[[branch]]\npath = \"0\"\naxis = [[0, 0, 1]]\n",
                "tree.toml:3: axis: got 1 points"},
        BadText{"AxisOfTwoPoints", "[[branch]]\npath = \"0\"\naxis = [[0, 0, 1], [0, 0, 2]]\n",
                "got 2 points of an axis, expected 3, 4, 6 or 10"},
        BadText{"AxisOfAThousandKilometres",
                "[[branch]]\npath = \"0\"\naxis = [[0, 0, 1], [0, 0, 2], [0, 0, 1e6]]\n",
                "tree.toml:3: axis: got the number 1000000 of an axis, expected one from -1000 to 1000"},
        BadText{"AxisOfNan", "[[branch]]\npath = \"0\"\naxis = [[0, 0, 1], [0, nan, 2], [0, 0, 3]]\n",
                "got the number nan"},
        BadText{"AxisOfOnePlace", "[[branch]]\npath = \"0\"\naxis = [[0, 0, 1], [0, 0, 1], [0, 0, 1]]\n",
                "tree.toml:3: axis: got points of an axis that are all the same"},
        BadText{"AxisInThePlane", "[[branch]]\npath = \"0\"\naxis = [[0, 1], [0, 2], [0, 3]]\n",
                "expected an array of points [x, y, z]"},
        BadText{"AxisOfText", "[[branch]]\npath = \"0\"\naxis = \"straight\"\n", "expected an array"},
        BadText{"UnknownFrame",
                "[[branch]]\npath = \"0\"\naxis = [[0, 0, 1], [0, 0, 2], [0, 0, 3]]\naxis_frame = \"sky\"\n",
                "tree.toml:4: axis_frame: got 'sky', expected \"parent\" or \"world\""},
        BadText{"FrameWithoutAxis", "[[branch]]\npath = \"0\"\naxis_frame = \"world\"\n",
                "tree.toml:3: axis_frame"},
        BadText{"BranchIsNoArray", "branch = 3\n", "branch"}),
    [](const auto& info) { return info.param.name; });

TEST(OverridesTree, ShowsCrowns) {
  const Overrides overrides = read("[[branch]]\npath = \"0/3\"\ncrown = { radius = 0.4, radius_up = 0.1 }\n");
  EXPECT_EQ(overrides_tree(overrides, {1}, "# "),
            "#   0/3: a crown of 0.4 to the right, 0.1 up, 0.4 to the left, 0.4 down\n");
}

TEST(OverridesTree, ShowsAxes) {
  const Overrides overrides =
      read("[[branch]]\npath = \"0\"\naxis = [[0, 0, 1], [0, 0, 2], [0, 0, 3]]\naxis_frame = \"world\"\n");
  const std::string tree = overrides_tree(overrides, {1}, "# ");
  EXPECT_EQ(tree, "# 0: axis of 3 points in the frame of the world\n");
}

/// A set's own axis comes before that of the set it shares.
TEST(OverridesToml, AxesAreShared) {
  const std::string shared = "[shared.arch]\naxis = [[0, 0, 1], [0, 0, 2], [0, 0, 3]]\n";
  const std::string
      first = "[[branch]]\npath = \"0/1\"\nshares = \"arch\"\n",
      second = "[[branch]]\npath = \"0/2\"\nshares = \"arch\"\naxis = [[1, 0, 1], [0, 0, 2], [0, 0, 3]]\n",
      third = "[[branch]]\npath = \"0/3\"\nlength = 1\n";
  const Overrides overrides = read(first + second + third + shared);
  const auto first_x = [&](std::size_t node) {
    return resolved_axis(overrides.nodes[node].set, overrides)->points[0].x;
  };
  EXPECT_EQ(first_x(0), 0);
  EXPECT_EQ(first_x(1), 1);
  EXPECT_EQ(resolved_axis(overrides.nodes[2].set, overrides), nullptr);
}

TEST(OverridesTree, ShowsDepthInheritanceAndDormantNodes) {
  const Overrides overrides = read(
      "[[branch]]\npath = \"0/3\"\nlength = { factor = 2 }\nradius = { factor = 3, private = true }\n"
      "[[branch]]\npath = \"0/3/1\"\ncurvature = { offset = -20 }\n");
  const std::string tree = overrides_tree(overrides, {1, 0}, "# ");
  EXPECT_EQ(tree,
            "#   0/3: length × 2, radius × 3 (private)\n"
            "#     0/3/1: curvature -20; inherits length × 2 from 0/3 [dormant]\n");
}

TEST(OverridesTree, CountsTheBranchesOfRangesAndCallsThoseOfNoneDormant) {
  const Overrides overrides = read(
      "[[branch]]\npath = \"0/3..7\"\nlength = { factor = 2 }\n"
      "[[branch]]\npath = \"0/@0.5..1\"\nlocked = true\n"
      "[[branch]]\npath = \"0/3..7/2\"\nsize = 4\n");
  EXPECT_EQ(overrides_tree(overrides, {5, 1, 0}, "# "),
            "#   0/3..7: length × 2 [5 branches]\n"
            "#   0/@0.5..1: locked [1 branch]\n"
            "#     0/3..7/2: size = 4; inherits length × 2 from 0/3..7 [dormant]\n");
}

/// s0 shares s1, and so on up to s<last>.
std::string chain_of_sets(std::size_t last) {
  std::string text;
  for (std::size_t i = 0; i < last; ++i) text += fmt::format("[shared.s{}]\nshares = \"s{}\"\n", i, i + 1);
  return text + fmt::format("[shared.s{}]\nlength = 2\n", last);
}

TEST(OverridesToml, SetsShareOneAnotherInARowOfBoundedLength) {
  const Overrides overrides = read(chain_of_sets(kLongestSharing));
  EXPECT_EQ(resolved_overrides(overrides.shared.at("s0"), overrides).size(), 1u);
  EXPECT_THAT(
      [] { read(chain_of_sets(kLongestSharing + 1)); },
      testing::ThrowsMessage<InputError>("tree.toml:2: overrides: got a chain of more than 64 shared sets, "
                                         "expected fewer"));
}

std::string ranges(std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += fmt::format("[[branch]]\npath = \"0/{}..{}\"\n", i, i + 2);
  return text;
}

TEST(OverridesToml, RangesAreOfBoundedNumber) {
  EXPECT_EQ(read(ranges(kMostRanges)).ranges.size(), kMostRanges);
  EXPECT_THAT([] { read(ranges(kMostRanges + 1)); }, testing::ThrowsMessage<InputError>(testing::HasSubstr(
                                                         "tree.toml:2002: path: got more than 1000 ranges")));
}

TEST(OverridesToml, BranchesMayComeInAnyOrderAndMoreThanOnce) {
  const Overrides overrides = read(
      "[[branch]]\npath = \"0/7\"\nlength = 2\n[[branch]]\npath = \"0/3\"\nradius = 1\n"
      "[[branch]]\npath = \"0/7\"\nradius = 3\n[[branch]]\npath = \"0\"\nlength = 4\n");
  ASSERT_EQ(overrides.nodes.size(), 3u);
  EXPECT_TRUE(std::is_sorted(overrides.nodes.begin(), overrides.nodes.end(),
                             [](const OverrideNode& a, const OverrideNode& b) { return a.path < b.path; }));
  EXPECT_EQ(overrides.find({0, 7})->set.overrides.size(), 2u);
}

}  // namespace
}  // namespace espalier
