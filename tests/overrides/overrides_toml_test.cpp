// Overrides in presets: read back as written, every bad entry refused with its line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include <espalier/core/error.h>
#include <espalier/overrides/overrides_toml.h>
#include <espalier/overrides/overrides_tree.h>

namespace espalier {
namespace {

Overrides read(const std::string& text) {
  const toml::table document = parse_toml(text, "tree.toml");
  Overrides overrides;
  read_overrides({document, "tree.toml"}, overrides);
  return overrides;
}

Override any_override() {
  const auto quantity = static_cast<Quantity>(*rc::gen::inRange(0, 9));
  const bool relative = static_cast<std::size_t>(quantity) < kRelativeQuantities;
  if (!relative) return {quantity, Relation::value, 1, *rc::gen::arbitrary<bool>()};
  const double number = *rc::gen::inRange(0, 1001) / 1000.0;
  return {quantity, static_cast<Relation>(*rc::gen::inRange(0, 3)), number, *rc::gen::arbitrary<bool>()};
}

bool same(const OverrideSet& a, const OverrideSet& b) {
  return a.shares == b.shares && a.crown == b.crown &&
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
                "key 'radius': got -1, expected a number from 0.001 to 10"},
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
        BadText{"BranchIsNoArray", "branch = 3\n", "branch"}),
    [](const auto& info) { return info.param.name; });

TEST(OverridesTree, ShowsCrowns) {
  const Overrides overrides = read("[[branch]]\npath = \"0/3\"\ncrown = { radius = 0.4, radius_up = 0.1 }\n");
  EXPECT_EQ(overrides_tree(
                overrides, [](const BranchPath&) { return true; }, "# "),
            "#   0/3: a crown of 0.4 to the right, 0.1 up, 0.4 to the left, 0.4 down\n");
}

TEST(OverridesTree, ShowsDepthInheritanceAndDormantNodes) {
  const Overrides overrides = read(
      "[[branch]]\npath = \"0/3\"\nlength = { factor = 2 }\nradius = { factor = 3, private = true }\n"
      "[[branch]]\npath = \"0/3/1\"\ncurvature = { offset = -20 }\n");
  const std::string tree = overrides_tree(
      overrides, [](const BranchPath& path) { return path.size() < 3; }, "# ");
  EXPECT_EQ(tree,
            "#   0/3: length × 2, radius × 3 (private)\n"
            "#     0/3/1: curvature -20; inherits length × 2 from 0/3 [dormant]\n");
}

}  // namespace
}  // namespace espalier
