// The table and the plain struct say the same.
#include <gtest/gtest.h>

#include <set>

#include <espalier/weber_penn/table/parameters.h>

namespace espalier {
namespace {

std::vector<double> default_values() {
  std::vector<double> values;
  for (const ParameterInfo& row : weber_penn_table().rows) values.push_back(row.default_value);
  return values;
}

TEST(WeberPennTable, DefaultsAreThoseOfTheStruct) {
  const WeberPennParameters from_table = weber_penn_parameters(default_values()), plain;
  EXPECT_EQ(from_table.g_scale, plain.g_scale);
  EXPECT_EQ(from_table.branches, plain.branches);
  EXPECT_EQ(from_table.curve_v, plain.curve_v);
  EXPECT_EQ(from_table.leaf_scale, plain.leaf_scale);
  EXPECT_EQ(from_table.prune_power_high, plain.prune_power_high);
}

TEST(WeberPennTable, NamesAreUniqueAndDefaultsInBounds) {
  std::set<std::string> names;
  for (const ParameterInfo& row : weber_penn_table().rows) {
    EXPECT_TRUE(names.insert(row.full_name()).second) << row.full_name();
    EXPECT_GE(row.default_value, row.lower) << row.full_name();
    EXPECT_LE(row.default_value, row.upper) << row.full_name();
    EXPECT_FALSE(row.help.empty()) << row.full_name();
  }
}

TEST(WeberPennTable, EachRowMovesAFieldOfItsOwn) {
  const auto bytes_of = [](const std::vector<double>& values) {
    const WeberPennParameters parameters = weber_penn_parameters(values);
    const auto* begin = reinterpret_cast<const float*>(&parameters);
    return std::vector<float>(begin, begin + sizeof(parameters) / sizeof(float));
  };
  const std::vector<double> defaults = default_values();
  const std::vector<float> plain = bytes_of(defaults);
  std::set<std::size_t> moved;
  for (std::size_t row = 0; row < defaults.size(); ++row) {
    std::vector<double> values = defaults;
    values[row] += 1;
    const std::vector<float> changed = bytes_of(values);
    std::size_t count = 0;
    for (std::size_t i = 0; i < plain.size(); ++i)
      if (changed[i] != plain[i]) {
        ++count;
        EXPECT_TRUE(moved.insert(i).second) << weber_penn_table().rows[row].full_name();
      }
    EXPECT_EQ(count, 1u) << weber_penn_table().rows[row].full_name();
  }
  EXPECT_EQ(moved.size(), plain.size());
}

TEST(WeberPennTable, EachRoleIsBorneOnceAndOfItsRowsLevel) {
  const ParameterTable& table = weber_penn_table();
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const auto [role, level] = table.rows[i].role;
    if (role == Role::none || role == Role::trunk_form) continue;
    EXPECT_EQ(table.find(role, level), i) << table.rows[i].full_name();
    EXPECT_EQ(level, goes_by_level(role) ? table.rows[i].level : -1) << table.rows[i].full_name();
  }
}

TEST(WeberPennTable, PlainValuesAreValid) {
  for (const ParameterInfo& row : weber_penn_table().rows)
    if (row.plain) {
      EXPECT_NO_THROW(check_value(row, *row.plain, "plain")) << row.full_name();
    }
}

/// What forms a trunk besides its roles is held at its plain value where a trunk is held.
TEST(WeberPennTable, WhatFormsATrunkHasAPlainValue) {
  for (const ParameterInfo& row : weber_penn_table().rows)
    if (row.role.role == Role::trunk_form) {
      EXPECT_TRUE(row.plain) << row.full_name();
    }
}

TEST(LevelIndex, DeeperLevelsUseTheLastValues) {
  EXPECT_EQ(level_index(0), 0);
  EXPECT_EQ(level_index(3), 3);
  EXPECT_EQ(level_index(7), 3);
}

}  // namespace
}  // namespace espalier
