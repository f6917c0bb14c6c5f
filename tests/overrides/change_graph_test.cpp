// Inheritance in the decomposition graph: laws of Boudon et al. 2003, §2.1 and §2.2.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <espalier/core/error.h>
#include <espalier/overrides/change_graph.h>

namespace espalier {
namespace {

Override factor(Quantity quantity, double number, bool is_private = false) {
  return {quantity, Relation::factor, number, is_private};
}
Override offset(Quantity quantity, double number, bool is_private = false) {
  return {quantity, Relation::offset, number, is_private};
}
Override value(Quantity quantity, double number, bool is_private = false) {
  return {quantity, Relation::value, number, is_private};
}

void say(Overrides& overrides, const BranchPath& path, const Override& entry) {
  set_override(overrides.at(path).set, entry);
}

/// What the model's `generated` becomes for the branch of this path.
float changed_at(const Overrides& overrides, const BranchPath& path, Quantity quantity, float generated) {
  const ChangeGraph graph(overrides);
  ChangeCursor cursor(&graph);
  for (const std::uint32_t index : path) cursor = cursor.child(index);
  return changed(cursor.change(), quantity, generated);
}

constexpr Quantity kLength = Quantity::length;

TEST(ChangeGraph, WithoutOverridesChangesNothing) {
  EXPECT_EQ(ChangeCursor().child(0).child(3).change(), nullptr);
  EXPECT_EQ(changed_at({}, {0, 1}, kLength, 2), 2);
}

TEST(ChangeGraph, WhatANodeSaysHoldsForAllBelowIt) {
  Overrides overrides;
  say(overrides, {0, 3}, factor(kLength, 2));
  EXPECT_EQ(changed_at(overrides, {0, 3}, kLength, 5), 10);
  EXPECT_EQ(changed_at(overrides, {0, 3, 1, 4}, kLength, 5), 10);
  EXPECT_EQ(changed_at(overrides, {0, 2}, kLength, 5), 5);
  EXPECT_EQ(changed_at(overrides, {0}, kLength, 5), 5);
}

TEST(ChangeGraph, APrivateValueIsPassedOverAndTheGrandparentsIsInherited) {
  Overrides overrides;
  say(overrides, {0}, factor(kLength, 3));
  say(overrides, {0, 3}, value(kLength, 1, true));
  EXPECT_EQ(changed_at(overrides, {0, 3}, kLength, 5), 1);
  EXPECT_EQ(changed_at(overrides, {0, 3, 1}, kLength, 5), 15);
}

TEST(ChangeGraph, RelativeValuesActOnWhatIsInherited) {
  Overrides overrides;
  say(overrides, {0}, value(kLength, 4));
  say(overrides, {0, 1}, factor(kLength, 0.5));
  say(overrides, {0, 1, 2}, offset(kLength, 1));
  EXPECT_EQ(changed_at(overrides, {0, 1}, kLength, 100), 2);
  EXPECT_EQ(changed_at(overrides, {0, 1, 2}, kLength, 100), 3);
}

TEST(ChangeGraph, AValueForgetsWhatWasInherited) {
  Overrides overrides;
  say(overrides, {0}, factor(kLength, 7));
  say(overrides, {0, 1}, value(kLength, 2));
  EXPECT_EQ(changed_at(overrides, {0, 1, 0}, kLength, 100), 2);
}

TEST(ChangeGraph, SeedsAndRemovalsAreNotInherited) {
  Overrides overrides;
  say(overrides, {0, 1}, value(Quantity::seed, 9));
  say(overrides, {0, 2}, value(Quantity::removed, 1));
  const ChangeGraph graph(overrides);
  const ChangeCursor trunk = ChangeCursor(&graph).child(0);
  EXPECT_EQ(trunk.child(1).change()->seed, 9u);
  EXPECT_TRUE(trunk.child(2).change()->removed);
  EXPECT_EQ(trunk.child(1).child(0).change(), nullptr);
  EXPECT_EQ(trunk.child(2).child(0).change(), nullptr);
}

TEST(ChangeGraph, SharedSetsComeFirstAndMayChangeForAllAtOnce) {
  Overrides overrides;
  overrides.shared["low"].overrides = {factor(kLength, 2)};
  overrides.at({0, 1}).set.shares = "low";
  overrides.at({0, 2}).set.shares = "low";
  say(overrides, {0, 2}, factor(kLength, 3));
  EXPECT_EQ(changed_at(overrides, {0, 1}, kLength, 1), 2);
  EXPECT_EQ(changed_at(overrides, {0, 2}, kLength, 1), 3);
  overrides.shared["low"].overrides = {factor(kLength, 5)};
  EXPECT_EQ(changed_at(overrides, {0, 1}, kLength, 1), 5);
}

TEST(ChangeGraph, ASharedSetThatLeadsBackToItselfIsRefused) {
  Overrides overrides;
  overrides.shared["a"].shares = "b";
  overrides.shared["b"].shares = "a";
  overrides.at({0}).set.shares = "a";
  EXPECT_THROW(ChangeGraph{overrides}, InputError);
}

TEST(ChangeGraph, AnUnknownSharedSetIsRefused) {
  Overrides overrides;
  overrides.at({0}).set.shares = "nobody";
  EXPECT_THROW(ChangeGraph{overrides}, InputError);
}

/// The rule of the paper, word by word: walk up to the first node that says something publicly.
RC_GTEST_PROP(ChangeGraph, AnInheritedValueIsThatOfTheFirstPublicNodeAbove, ()) {
  const auto said =
      *rc::gen::container<std::vector<int>>(5, rc::gen::inRange(0, 3));  // 0 nothing, 1 public, 2 private
  Overrides overrides;
  BranchPath path;
  for (std::size_t depth = 0; depth < said.size(); ++depth) {
    path.push_back(static_cast<std::uint32_t>(depth));
    if (said[depth] > 0)
      say(overrides, path, value(kLength, static_cast<double>(depth) + 1, said[depth] == 2));
  }
  path.push_back(99);
  float expected = 77;
  for (std::size_t depth = 0; depth < said.size(); ++depth)
    if (said[depth] == 1) expected = static_cast<float>(depth) + 1;
  RC_ASSERT(changed_at(overrides, path, kLength, 77) == expected);
}

TEST(ChangeGraph, ACrownIsOfItsBranchAloneAndMayBeShared) {
  Overrides overrides;
  overrides.shared["pad"].crown = BranchCrown{.shape_tip = 3};
  overrides.shared["low"].shares = "pad";
  overrides.at({0, 3}).set.shares = "low";
  overrides.at({0, 4}).set.shares = "low";
  overrides.at({0, 4}).set.crown = BranchCrown{.shape_tip = 4};
  const ChangeGraph graph(overrides);
  const ChangeCursor trunk = ChangeCursor(&graph).child(0);
  ASSERT_TRUE(trunk.child(3).crown());
  EXPECT_EQ(trunk.child(3).crown()->shape_tip, 3);
  EXPECT_EQ(trunk.child(4).crown()->shape_tip, 4);
  EXPECT_FALSE(trunk.crown());
  EXPECT_FALSE(trunk.child(3).child(0).crown());
  EXPECT_FALSE(trunk.child(5).crown());
  EXPECT_FALSE(ChangeCursor().crown());
}

}  // namespace
}  // namespace espalier
