// Nodes of ranges: which branches they are of, and what comes of several that are of one branch.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numeric>

#include <espalier/core/error.h>
#include <espalier/overrides/change_graph.h>
#include <espalier/overrides/overrides_toml.h>

#include "overrides/test_table.h"

namespace espalier {
namespace {

using Kind = PatternPart::Kind;

BranchPattern pattern(const std::string& text) { return parse_branch_pattern(text, "here"); }

/// A child, and where it stands.
struct Step {
  std::uint32_t index = 0;
  float position = 0;
};
using Way = std::vector<Step>;

ChangeCursor cursor_at(const ChangeGraph& graph, const Way& way) {
  ChangeCursor cursor(&graph);
  for (const Step& step : way) cursor = cursor.child(step.index, step.position);
  return cursor;
}

float length_at(const Overrides& overrides, const Way& way) {
  const ChangeGraph graph(overrides);
  return changed(cursor_at(graph, way).change(), Quantity::length, 1);
}

void say_factor(Overrides& overrides, const std::string& path, double number, bool is_private = false) {
  set_override(overrides.set_of(pattern(path)), {Quantity::length, Relation::factor, number, is_private});
}
void say_value(Overrides& overrides, const std::string& path, double number, bool is_private = false) {
  set_override(overrides.set_of(pattern(path)), {Quantity::length, Relation::value, number, is_private});
}

TEST(BranchPattern, AreWrittenAsTheyAreRead) {
  for (const char* text : {"0", "0/3", "0/3..7", "0/@0.25..0.5", "0/*", "*/2..2/@0..1/split4.1", "0/*/2"})
    EXPECT_EQ(to_string(pattern(text)), text);
  EXPECT_EQ(to_string(pattern("0/@.25...5")), "0/@0.25..0.5");
}

RC_GTEST_PROP(BranchPattern, TextOfAPathReadsBackToThePath, ()) {
  BranchPath path;
  const int parts = *rc::gen::inRange(1, 6);
  for (int i = 0; i < parts; ++i) {
    const bool split = *rc::gen::arbitrary<bool>();
    const std::uint32_t child = *rc::gen::inRange<std::uint32_t>(0, kFirstSplit);
    const std::uint32_t at = *rc::gen::inRange<std::uint32_t>(0, 1001),
                        number = *rc::gen::inRange<std::uint32_t>(0, kStemsPerSplit);
    path.push_back(split ? kFirstSplit + kStemsPerSplit * at + number : child);
  }
  RC_ASSERT(as_path(pattern(to_string(path))) == path);
}

TEST(BranchPattern, IndexRangesHaveBothTheirEnds) {
  Overrides overrides;
  say_factor(overrides, "0/3..7", 2);
  for (const std::uint32_t index : {2u, 8u}) EXPECT_EQ(length_at(overrides, {{0}, {index}}), 1) << index;
  for (const std::uint32_t index : {3u, 5u, 7u}) EXPECT_EQ(length_at(overrides, {{0}, {index}}), 2) << index;
}

TEST(BranchPattern, PositionRangesHaveTheirLowerEndAndTheTip) {
  Overrides overrides;
  say_factor(overrides, "0/@0.25..0.5", 2);
  say_factor(overrides, "0/@0.75..1", 3);
  const std::pair<float, float> kExpected[] = {{0.24f, 1}, {0.25f, 2}, {0.49f, 2},
                                               {0.5f, 1},  {0.8f, 3},  {1.f, 3}};
  for (const auto& [position, length] : kExpected)
    EXPECT_EQ(length_at(overrides, {{0}, {4, position}}), length) << position;
}

TEST(BranchPattern, RangesMeanNoStemsThatSplitOff) {
  Overrides overrides;
  say_factor(overrides, "0/*", 2, true);
  say_factor(overrides, "0/@0..1", 2, true);
  EXPECT_EQ(length_at(overrides, {{0}, {kFirstSplit, 0.5f}}), 1);
  EXPECT_EQ(length_at(overrides, {{0}, {3, 0.5f}}), 4);
}

TEST(BranchPattern, MayHaveRangesWithinThePath) {
  Overrides overrides;
  say_factor(overrides, "0/*/2", 3);
  EXPECT_EQ(length_at(overrides, {{0}, {9}, {2}}), 3);
  EXPECT_EQ(length_at(overrides, {{0}, {9}, {2}, {5}}), 3);
  EXPECT_EQ(length_at(overrides, {{0}, {9}, {3}}), 1);
  EXPECT_EQ(length_at(overrides, {{0}, {9}}), 1);
}

/// Values show who comes last; the order of the file does not matter between kinds.
TEST(BranchPattern, SingleOnesAreStrongerThanIndicesThanPositionsThanStars) {
  std::vector<std::string> paths{"0/5", "0/5..6", "0/@0.4..0.6", "0/*"};
  const Way way{{0}, {5, 0.5f}};
  for (std::size_t strongest = 0; strongest < paths.size(); ++strongest) {
    Overrides overrides, reversed;
    for (std::size_t i = strongest; i < paths.size(); ++i)
      say_value(overrides, paths[i], static_cast<double>(i) + 10);
    for (std::size_t i = paths.size(); i-- > strongest;)
      say_value(reversed, paths[i], static_cast<double>(i) + 10);
    EXPECT_EQ(length_at(overrides, way), static_cast<float>(strongest) + 10);
    EXPECT_EQ(length_at(reversed, way), static_cast<float>(strongest) + 10);
  }
}

TEST(BranchPattern, TheFirstPartWhoseKindsDifferDecides) {
  Overrides overrides;
  say_value(overrides, "0/3/*", 7);
  say_value(overrides, "0/*/2", 8);
  EXPECT_EQ(length_at(overrides, {{0}, {3}, {2}}), 7);
}

TEST(BranchPattern, OfTwoOfAKindTheLaterOneIsStronger) {
  Overrides overrides;
  say_value(overrides, "0/3..7", 7);
  say_value(overrides, "0/5..9", 8);
  EXPECT_EQ(length_at(overrides, {{0}, {5}}), 8);
  EXPECT_EQ(length_at(overrides, {{0}, {4}}), 7);
}

TEST(BranchPattern, RelativeValuesActOnWhatWeakerNodesSay) {
  Overrides overrides;
  say_value(overrides, "0/*", 4);
  say_factor(overrides, "0/3..7", 2);
  say_factor(overrides, "0/5", 3);
  EXPECT_EQ(length_at(overrides, {{0}, {5}}), 24);
  EXPECT_EQ(length_at(overrides, {{0}, {4}}), 8);
  EXPECT_EQ(length_at(overrides, {{0}, {9}}), 4);
}

PatternPart any_part(bool is_trunk) {
  const auto kind = static_cast<Kind>(*rc::gen::inRange(0, 4));
  const auto first = static_cast<std::uint32_t>(*rc::gen::inRange(0, 4));
  const auto last = first + static_cast<std::uint32_t>(*rc::gen::inRange(0, 3));
  const float lower = static_cast<float>(*rc::gen::inRange(0, 4)) / 4;
  if (kind == Kind::one) return {.first = first, .last = first};
  if (kind == Kind::indices) return {.kind = kind, .first = first, .last = last};
  if (kind == Kind::all || is_trunk) return {.kind = Kind::all};
  return {.kind = kind,
          .lower = lower,
          .upper = std::min(1.f, lower + 0.25f * static_cast<float>(*rc::gen::inRange(1, 4)))};
}

bool means(const BranchPattern& pattern, const Way& way, std::size_t parts) {
  if (pattern.size() != parts) return false;
  for (std::size_t i = 0; i < parts; ++i)
    if (!pattern[i].means(way[i].index, way[i].position)) return false;
  return true;
}

/// The rule word by word: from the trunk on, all nodes of each stem in their order; private ones for the
/// last.
RC_GTEST_PROP(BranchPattern, ABranchIsToldWhatAllNodesOfItAndOfThoseBelowItSay, ()) {
  struct Said {
    BranchPattern pattern;
    Override entry;
  };
  std::vector<Said> all;
  Overrides overrides;
  for (int i = *rc::gen::inRange(0, 9); i > 0; --i) {
    BranchPattern path;
    for (int part = *rc::gen::inRange(1, 4); part > 0; --part) path.push_back(any_part(path.empty()));
    const Override entry{Quantity::length, *rc::gen::arbitrary<bool>() ? Relation::value : Relation::factor,
                         static_cast<double>(*rc::gen::inRange(1, 5)), *rc::gen::arbitrary<bool>()};
    OverrideSet& set = overrides.set_of(path);
    if (!set.empty()) continue;
    set_override(set, entry);
    all.push_back({path, entry});
  }
  Way way;
  for (int part = *rc::gen::inRange(1, 5); part > 0; --part)
    way.push_back({static_cast<std::uint32_t>(*rc::gen::inRange(0, 6)),
                   static_cast<float>(*rc::gen::inRange(0, 9)) / 8});
  Modification expected;
  for (std::size_t parts = 1; parts <= way.size(); ++parts) {
    std::vector<Said> of_stem;
    std::copy_if(all.begin(), all.end(), std::back_inserter(of_stem),
                 [&](const Said& said) { return means(said.pattern, way, parts); });
    std::stable_sort(of_stem.begin(), of_stem.end(),
                     [](const Said& a, const Said& b) { return is_weaker(a.pattern, b.pattern); });
    for (const Said& said : of_stem)
      if (!said.entry.is_private || parts == way.size())
        expected =
            combined(expected, modification(said.entry.relation, static_cast<float>(said.entry.number)));
  }
  RC_ASSERT(length_at(overrides, way) == expected.apply(1));
  const Overrides back = [&] {
    Overrides result;
    const toml::table document = parse_toml(overrides_to_toml(overrides), "tree.toml");
    read_overrides({document, "tree.toml"}, test_table(), result);
    return result;
  }();
  RC_ASSERT(length_at(back, way) == expected.apply(1));
}

TEST(BranchPattern, LocksHoldForAllOnTheBranch) {
  Overrides overrides;
  overrides.set_of(pattern("0/3..4")).is_locked = true;
  overrides.set_of(pattern("0/4/1")).is_locked = false;
  const ChangeGraph graph(overrides);
  EXPECT_FALSE(cursor_at(graph, {{0}}).is_locked());
  EXPECT_FALSE(cursor_at(graph, {{0}, {2}}).is_locked());
  EXPECT_TRUE(cursor_at(graph, {{0}, {3}}).is_locked());
  EXPECT_TRUE(cursor_at(graph, {{0}, {3}, {7}, {1}}).is_locked());
  EXPECT_FALSE(cursor_at(graph, {{0}, {4}, {1}}).is_locked());
}

TEST(BranchPattern, TooManyWaysToMeetAreRefused) {
  Overrides overrides;
  for (int i = 0; i < 400; ++i) {
    say_factor(overrides, fmt::format("0/{}..{}", i, i + 400), 1);
    say_factor(overrides, fmt::format("0/@{}..1", 0.001 * i), 1);
  }
  EXPECT_THROW(ChangeGraph{overrides}, InputError);
}

class BadPath : public testing::TestWithParam<const char*> {};

TEST_P(BadPath, IsRefusedWithThePlaceAndTheText) {
  try {
    parse_branch_pattern(GetParam(), "tree.toml:7");
    FAIL() << "accepted '" << GetParam() << "'";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_TRUE(message.starts_with("tree.toml:7: got '")) << message;
    EXPECT_NE(message.find(GetParam()), std::string::npos) << message;
  }
}

INSTANTIATE_TEST_SUITE_P(All, BadPath,
                         testing::Values("", "/", "0/", "/0", "0//1", "-1", "a", "0/1.5", "0/split",
                                         "0/split4", "0/split4.16", "0/splitx.1", "1000000", "99999999999",
                                         "0 /1"));

struct BadPattern {
  const char *name, *text, *message;
};

class BadPatterns : public testing::TestWithParam<BadPattern> {};

TEST_P(BadPatterns, AreRefusedInOneLine) {
  try {
    pattern(GetParam().text);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("here: got '"));
    EXPECT_THAT(error.what(), testing::HasSubstr(GetParam().message));
    EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n")));
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, BadPatterns,
    testing::Values(BadPattern{"Backwards", "0/7..3", "whose range '7..3' holds nothing"},
                    BadPattern{"NoPositions", "0/@.5...5", "whose range '@.5...5' holds nothing"},
                    BadPattern{"OpenPositions", "0/@.5..", "positions from 0 to 1"},
                    BadPattern{"OnePosition", "0/@0.5", "a range of positions"},
                    BadPattern{"BeyondTheTip", "0/@0.5..1.5", "positions from 0 to 1"},
                    BadPattern{"NoNumber", "0/@nan..1", "positions from 0 to 1"},
                    BadPattern{"PositionsOfTrunks", "@0..1", "branches that have a parent"},
                    BadPattern{"OpenIndices", "0/3..", "a path of branches"},
                    BadPattern{"RangeOfSplits", "0/split1.0..split2.0", "a path of branches"},
                    BadPattern{"TwoStars", "0/**", "a path of branches"},
                    BadPattern{"Empty", "", "a path of branches"},
                    BadPattern{"EmptyPart", "0//3", "a path of branches"}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace espalier
