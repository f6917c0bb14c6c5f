// What a line "param …" says of a row of the table.
#include <gtest/gtest.h>

#include <espalier/lsystem/files/grammar_file.h>

namespace espalier::lsystem {
namespace {

ParameterTable table_of(const std::string& parameters) {
  return parse_grammar(parameters + "\naxiom: A\n", "test.lsys").parameters;
}

TEST(ParseParameter, RolesAndPlainValuesStandAmongTheOtherWords) {
  const ParameterTable table = table_of(
      "param leaves = 12 in 1 .. 40 integer role leaf_count \"on a twig\"\n"
      "param sway = 9 in 0 .. 30 plain 0 deg\n"
      "param whorl = 5 in 3 .. 8 role branch_count[2] integer");
  EXPECT_EQ(table.find(Role::leaf_count), 0u);
  EXPECT_EQ(table.rows[0].scale, Scale::integer);
  EXPECT_EQ(table.rows[0].help, "on a twig");
  EXPECT_EQ(table.rows[1].plain, 0);
  EXPECT_EQ(table.rows[1].unit, "deg");
  EXPECT_EQ(table.find(Role::branch_count, 2), 2u);
  EXPECT_EQ(table.rows[2].scale, Scale::integer);
}

TEST(ParseParameter, WhatSaysNoRoleBearsNone) {
  const ParameterTable table = table_of("param spread = 40 in 10 .. 80 deg \"role leaf_count\"");
  EXPECT_EQ(table.rows[0].role, RoleOfLevel{});
  EXPECT_FALSE(table.rows[0].plain);
}

TEST(ParseParameter, SeveralMayFormTheTrunk) {
  const ParameterTable table =
      table_of("param a = 1 in 0 .. 9 role trunk_form\nparam b = 1 in 0 .. 9 role trunk_form");
  EXPECT_EQ(table.rows[1].role.role, Role::trunk_form);
}

}  // namespace
}  // namespace espalier::lsystem
