// The table and the plain struct say the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
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
    return std::vector<float>(begin, begin + offsetof(WeberPennParameters, curves) / sizeof(float));
  };
  const std::vector<double> defaults = default_values();
  const std::vector<float> plain = bytes_of(defaults);
  std::set<std::size_t> moved;
  for (std::size_t row = 0; row < defaults.size(); ++row) {
    std::vector<double> values = defaults;
    values[row] += 1;
    const std::vector<float> changed = bytes_of(values);
    if (weber_penn_table().rows[row].point >= 0) {
      EXPECT_EQ(changed, plain) << weber_penn_table().rows[row].full_name();
      continue;
    }
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

/// Which curves are not neutral, in the order of the struct.
std::vector<bool> curves_in_use(const StemCurves& c) {
  std::vector<bool> in_use;
  const auto add = [&](const auto& levels) {
    for (const auto& curve : levels) in_use.push_back(!curve.is_neutral);
  };
  add(c.density_along);
  for (const AlongLevels& levels :
       {c.length_along, c.down_angle_along, c.curve_along, c.bend_along, c.radius_along})
    add(levels);
  in_use.push_back(!c.leaf_scale_along.is_neutral);
  in_use.push_back(!c.leaf_density_along.is_neutral);
  return in_use;
}

TEST(WeberPennTable, EachCurveMovesACurveOfItsOwn) {
  std::set<std::size_t> moved;
  const ParameterTable& table = weber_penn_table();
  for (const CurveInfo& curve : table.curves)
    for (std::size_t point = 0; point < kCurveRows; ++point) {
      std::vector<double> values = default_values();
      values[curve.first_row + point] += 1;
      const std::vector<bool> in_use = curves_in_use(weber_penn_parameters(values).curves);
      ASSERT_EQ(std::count(in_use.begin(), in_use.end(), true), 1) << curve.full_name();
      const auto at =
          static_cast<std::size_t>(std::find(in_use.begin(), in_use.end(), true) - in_use.begin());
      EXPECT_EQ(moved.insert(at).second, point == 0) << curve.full_name();
    }
  EXPECT_EQ(moved.size(), table.curves.size());
}

TEST(WeberPennTable, CurvesAreTheLastRowsNeutralAndNotFree) {
  const ParameterTable& table = weber_penn_table();
  std::size_t next = table.curves.front().first_row;
  for (const CurveInfo& curve : table.curves) {
    EXPECT_EQ(curve.first_row, next);
    EXPECT_TRUE(is_neutral(curve, default_values())) << curve.full_name();
    for (std::size_t row = next; row < next + kCurveRows; ++row) {
      EXPECT_FALSE(table.rows[row].free_by_default);
      EXPECT_EQ(table.rows[row].plain, curve.neutral);
      EXPECT_EQ(table.curve_of(row), &curve);
    }
    next += kCurveRows;
  }
  EXPECT_EQ(next, table.rows.size());
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
