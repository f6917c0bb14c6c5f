// Names of roles: each is read back, and what is none is answered with the closest.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <espalier/core/error.h>
#include <espalier/core/parameter_role.h>
#include <espalier/core/parameter_table.h>

namespace espalier {
namespace {

std::string message_for(const std::string& name) {
  try {
    role_by_name(name);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Role, EveryNameIsReadBack) {
  for (int i = 1; i <= static_cast<int>(Role::blossom_share); ++i) {
    const auto role = static_cast<Role>(i);
    for (const int level : goes_by_level(role) ? std::vector{1, 2, 3} : std::vector{-1}) {
      const RoleOfLevel expected{role, level};
      EXPECT_EQ(role_by_name(role_name(expected)), expected) << role_name(expected);
    }
  }
}

TEST(Role, ThatGoesByLevelIsOfTheFirstWhereNoneIsSaid) {
  EXPECT_EQ(role_by_name("branch_count"), (RoleOfLevel{Role::branch_count, 1}));
}

TEST(Role, UnknownNamesAreAnsweredWithTheClosest) {
  EXPECT_EQ(message_for("leaf_cuont"), "got role 'leaf_cuont', expected one like 'leaf_count'");
  EXPECT_THAT(message_for("branch_count[4]"), testing::HasSubstr("a level 1 to 3"));
  EXPECT_THAT(message_for("branch_count[]"), testing::HasSubstr("a level 1 to 3"));
  EXPECT_THAT(message_for("leaf_count[1]"), testing::HasSubstr("'leaf_count', which has no levels"));
}

ParameterTable toy_table() {
  ParameterTable table{"toy", {}};
  table.rows.resize(3);
  table.rows[1].role = {Role::branch_count, 2};
  table.rows[1].upper = 9;
  table.rows[2].role = {Role::length_unit};
  return table;
}

TEST(Role, IsFoundByItsLevel) {
  const ParameterTable table = toy_table();
  EXPECT_EQ(table.find(Role::branch_count, 2), 1u);
  EXPECT_EQ(table.find(Role::branch_count, 1), std::nullopt);
  EXPECT_EQ(table.find(Role::leaf_count), std::nullopt);
}

TEST(Role, IsSetToTheNearestValidValue) {
  ParameterValues values{1, 1, 1};
  EXPECT_TRUE(set_role(toy_table(), {Role::branch_count, 2}, 20, values));
  EXPECT_FALSE(set_role(toy_table(), {Role::leaf_count}, 20, values));
  EXPECT_EQ(values, (ParameterValues{1, 9, 1}));
}

TEST(Role, LengthsAreInTheUnitsOfTheModel) {
  EXPECT_EQ(in_own_units(toy_table(), 3, {1, 1, 0.5}), 6);
  EXPECT_EQ(in_own_units({"metres", {}}, 3, {}), 3);
}

}  // namespace
}  // namespace espalier
