// Overrides of rows and curves: laws of Boudon et al. 2003, §2.1, on any table; every bad entry refused.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <espalier/core/error.h>
#include <espalier/overrides/change_graph.h>
#include <espalier/overrides/overrides_toml.h>

#include "overrides/test_table.h"

namespace espalier {
namespace {

Overrides read_tree(const std::string& text) {
  const toml::table document = parse_toml(text, "tree.toml");
  Overrides overrides;
  read_overrides({document, "tree.toml"}, test_table(), overrides);
  return overrides;
}

/// A branch's values where the tree's are the defaults.
ParameterValues values_at(const std::string& text, const BranchPath& path) {
  const Overrides overrides = read_tree(text);
  const ChangeGraph graph(overrides);
  ChangeCursor cursor(&graph);
  for (const std::uint32_t part : path) cursor = cursor.child(part);
  const ParameterValues of_tree = test_table().defaults();
  if (cursor.row_changes() < 0) return of_tree;
  const BranchRows& rows = graph.row_changes()[static_cast<std::size_t>(cursor.row_changes())];
  return changed_values(test_table(), of_tree, rows.changes);
}

double value_at(const std::string& text, const BranchPath& path, const char* name) {
  return values_at(text, path)[test_table().index_of(name)];
}

std::string node(const char* path, const std::string& says) {
  return fmt::format("[[branch]]\npath = \"{}\"\n{}\n", path, says);
}

TEST(ParameterOverrides, HoldForTheBranchAndAllOnIt) {
  const std::string text = node("0/3", "size = 2");
  EXPECT_EQ(value_at(text, {0, 3}, "size"), 2);
  EXPECT_EQ(value_at(text, {0, 3, 1, 5}, "size"), 2);
  EXPECT_EQ(value_at(text, {0, 4}, "size"), 4);
  EXPECT_EQ(value_at(text, {0}, "size"), 4);
}

TEST(ParameterOverrides, PrivateOnesArePassedOver) {
  const std::string text = node("0", "size = 3") + node("0/3", "size = { value = 2, private = true }");
  EXPECT_EQ(value_at(text, {0, 3}, "size"), 2);
  EXPECT_EQ(value_at(text, {0, 3, 1}, "size"), 3);
}

TEST(ParameterOverrides, RelativeOnesActOnWhatIsInherited) {
  const std::string text =
      node("0", "size = 3") + node("0/3", "size = { factor = 0.5 }") + node("0/3/1", "size = { offset = 1 }");
  EXPECT_EQ(value_at(text, {0, 3}, "size"), 1.5);
  EXPECT_EQ(value_at(text, {0, 3, 1}, "size"), 2.5);
}

TEST(ParameterOverrides, ThoseOfABranchReplaceThoseOfTheSetItShares) {
  const std::string text = "[shared.low]\nsize = { factor = 0.5 }\nkind = \"flat\"\n" +
                           node("0/3", "shares = \"low\"") + node("0/4", "shares = \"low\"\nsize = 9");
  EXPECT_EQ(value_at(text, {0, 3}, "size"), 2);
  EXPECT_EQ(value_at(text, {0, 4}, "size"), 9);
  EXPECT_EQ(value_at(text, {0, 4}, "kind"), 1);
}

TEST(ParameterOverrides, ANameWithoutALevelMeansAllLevelsButThoseThatAreNamed) {
  const std::string text = node("0", "count = { factor = 0.5 }\n\"count[1]\" = { offset = 7 }");
  EXPECT_EQ(value_at(text, {0}, "count[0]"), 5);
  EXPECT_EQ(value_at(text, {0}, "count[1]"), 17);
  EXPECT_EQ(value_at(text, {0}, "count[3]"), 5);
}

TEST(ParameterOverrides, AnArrayGivesOneNumberToEachLevelFromTheFirst) {
  const std::string text = node("0", "count = [1, 2]");
  EXPECT_EQ(value_at(text, {0}, "count[0]"), 1);
  EXPECT_EQ(value_at(text, {0}, "count[1]"), 2);
  EXPECT_EQ(value_at(text, {0}, "count[2]"), 10);
}

TEST(ParameterOverrides, RelativeOnesStopAtTheBoundsAndAreWholeWhereTheRowIs) {
  EXPECT_EQ(value_at(node("0", "size = { factor = 9 }"), {0}, "size"), 10);
  EXPECT_EQ(value_at(node("0", "size = { offset = -9 }"), {0}, "size"), 0);
  EXPECT_EQ(value_at(node("0", "count = { factor = 0.16 }"), {0}, "count[1]"), 2);
}

/// Clamped once, at the end: what goes beyond a bound may come back.
TEST(ParameterOverrides, RelativeOnesMayLeaveTheBoundsOnTheWay) {
  const std::string text = node("0", "size = { factor = 4 }") + node("0/1", "size = { factor = 0.25 }");
  EXPECT_EQ(value_at(text, {0}, "size"), 10);
  EXPECT_EQ(value_at(text, {0, 1}, "size"), 4);
}

TEST(ParameterOverrides, FactorsOfACurveMultiplyItNumberByNumber) {
  const std::string text = node("0", "\"along[1]\" = [2, 2, 4, 4]") +
                           node("0/1", "\"along[2]\" = { factor = [1, 1, 0.5, 0.2] }") +
                           node("0/2", "along = { factor = 0.5, private = true }");
  EXPECT_EQ(value_at(text, {0, 1}, "along[2].1"), 1);
  EXPECT_EQ(value_at(text, {0, 1}, "along[2].7"), 0.2);
  EXPECT_EQ(value_at(text, {0, 2}, "along[1].1"), 1);
  EXPECT_EQ(value_at(text, {0, 2}, "along[1].7"), 2);
  EXPECT_EQ(value_at(text, {0, 2}, "along[2].4"), 0.5);
}

/// They are one axis: what is private to a stem is not handed on to its children, but to its parts.
TEST(ParameterOverrides, AStemThatSplitsOffHasWhatItsStemHas) {
  const std::string text = node("0", "size = { value = 2, private = true }\ncount = 3") +
                           node("0/split2.0", "size = { factor = 2 }");
  EXPECT_EQ(value_at(text, {0, kFirstSplit + 2 * kStemsPerSplit}, "size"), 4);
  EXPECT_EQ(value_at(text, {0, kFirstSplit + 2 * kStemsPerSplit}, "count[1]"), 3);
  EXPECT_EQ(value_at(text, {0, kFirstSplit + 2 * kStemsPerSplit, 1}, "size"), 8);
  EXPECT_EQ(value_at(text, {0, 1}, "size"), 4);
}

RC_GTEST_PROP(ParameterOverrides, ReadBackTheSameBits, ()) {
  const std::string key =
      *rc::gen::element<std::string>("size", "count", "count[3]", "along", "along[2]", "dense", "tilt");
  const std::string relation = *rc::gen::element<std::string>("value", "factor", "offset");
  const auto number = [] { return *rc::gen::inRange(1, 1000) / 1000.0; };
  std::string numbers = key.starts_with("count") ? "7" : fmt::format("{}", number());
  if (key == "along" && *rc::gen::arbitrary<bool>())
    numbers = fmt::format("[{}, {}, {}, {}]", number(), number(), number(), number());
  if (key == "tilt" && *rc::gen::arbitrary<bool>()) numbers = fmt::format("[{}, {}]", number(), number());
  const std::string is_private = *rc::gen::arbitrary<bool>() ? "true" : "false";
  const Overrides first = read_tree(
      node("0", fmt::format("\"{}\" = {{ {} = {}, private = {} }}", key, relation, numbers, is_private)));
  const Overrides second = read_tree(overrides_to_toml(first));
  const ParameterOverride &a = first.nodes.at(0).set.parameters.at(0),
                          &b = second.nodes.at(0).set.parameters.at(0);
  RC_ASSERT(a.key == b.key);
  RC_ASSERT(a.relation == b.relation);
  RC_ASSERT(a.numbers == b.numbers);
  RC_ASSERT(a.is_list == b.is_list);
  RC_ASSERT(a.is_private == b.is_private);
  RC_ASSERT(std::ranges::equal(a.rows, b.rows, [](const RowNumber& x, const RowNumber& y) {
    return x.row == y.row && x.number == y.number;
  }));
}

struct BadParameter {
  const char *name, *path, *says, *message;
};

class BadParameters : public testing::TestWithParam<BadParameter> {};

TEST_P(BadParameters, AreRefusedInOneLineWithTheirPlace) {
  try {
    read_tree(node(GetParam().path, GetParam().says));
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("tree.toml:3"));
    EXPECT_THAT(error.what(), testing::HasSubstr(GetParam().message));
    EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n")));
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, BadParameters,
    testing::Values(
        BadParameter{"Unknown", "0", "seize = 1", "got an unknown key, expected one like 'size'"},
        BadParameter{"UnknownLevel", "0", "\"count[7]\" = 1",
                     "got an unknown key, expected one like 'count["},
        BadParameter{"NumberOfACurve", "0", "\"along[1].3\" = 1", "got an unknown key"},
        BadParameter{"OfThePlant", "0/1", "whole = 1",
                     "key 'whole': got one for a branch, expected none: a plant of test has it as a whole"},
        BadParameter{"OfAShallowerLevel", "0/1", "\"count[0]\" = 1",
                     "key 'count[0]': got one for a branch of level 1, expected a level of at most 0"},
        BadParameter{"OfWhatBearsIt", "0/1/2", "\"along[2]\" = 1", "got one for a branch of level 2"},
        BadParameter{"OutOfBounds", "0", "size = 11", "key 'size': got 11, expected a number 0..10"},
        BadParameter{"Negative", "0", "size = -1", "key 'size': got -1, expected a number 0..10"},
        BadParameter{"NotFinite", "0", "size = nan", "key 'size': got nan"},
        BadParameter{"InfiniteFactor", "0", "size = { factor = inf }", "got inf as factor"},
        BadParameter{"NegativeFactor", "0", "size = { factor = -1 }", "from 0 to 1e+06"},
        BadParameter{"OffsetThatIsNoNumber", "0", "size = { offset = nan }", "got nan as offset"},
        BadParameter{"Text", "0", "size = \"big\"", "key 'size': got 'big'"},
        BadParameter{"Flag", "0", "size = true", "key 'size': got true"},
        BadParameter{"UnknownChoice", "0", "kind = \"square\"", "expected one of round, flat, long"},
        BadParameter{"FactorOfAChoice", "0", "kind = { factor = 2 }", "expected a value: it is a choice"},
        BadParameter{"HalfACount", "0", "\"count[1]\" = 2.5", "expected a whole number 0..50"},
        BadParameter{"MoreThanLevels", "0", "count = [1, 2, 3, 4, 5]", "got an array of 5"},
        BadParameter{"NoNumbers", "0", "count = []", "got an array of 0"},
        BadParameter{"ArrayOfOneRow", "0", "size = [1]", "got an array of 1"},
        BadParameter{"CurveOfTwo", "0", "\"along[1]\" = [1, 2]", "got 2 numbers"},
        BadParameter{"CurveOfThree", "0", "\"along[1]\" = { factor = [1, 2, 3] }", "got 3 numbers"},
        BadParameter{"CurveOfSix", "0", "along = [1, 2, 3, 4, 5, 6]", "got 6 numbers"},
        BadParameter{"CurveOutOfBounds", "0", "along = [1, 2, 3, 11]", "got 11, expected a number 0..10"},
        BadParameter{"NegativeFactorOfACurve", "0", "along = { factor = [1, 1, 1, -1] }", "got -1 as factor"},
        BadParameter{"NoDensityAnywhere", "0", "dense = 0", "got a density of 0 everywhere"}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace espalier
