// Curves of a table: 1, 4, 5 or 7 numbers become 7 rows and are the same curve.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include <espalier/core/curves/parameter_curves.h>
#include <espalier/core/error.h>

namespace espalier {
namespace {

using testing::HasSubstr;

/// A row, then a factor of level 2 and a density of the whole plant.
ParameterTable two_curves() {
  ParameterTable table{"two", {{.name = "size"}}};
  const auto add = [&](const char* name, int level, CurveRole role) {
    table.curves.push_back({.name = name, .level = level, .first_row = table.rows.size(), .role = role});
    for (int point = 0; point < static_cast<int>(kCurveRows); ++point)
      table.rows.push_back(
          {.name = name, .level = level, .point = point, .lower = 0, .upper = 10, .default_value = 1});
  };
  add("width_along", 2, CurveRole::factor);
  add("crowd_along", -1, CurveRole::density);
  return table;
}

const ParameterTable& table() {
  static const ParameterTable kTable = two_curves();
  return kTable;
}

std::string error_of(const char* curve, const std::vector<double>& numbers) {
  ParameterValues values = table().defaults();
  try {
    set_curve(table(), *table().find_curve(curve), numbers, "tree.toml:3", values);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

Curve curve_in(const CurveInfo& curve, const ParameterValues& values) {
  return make_curve(std::span(values).subspan(curve.first_row, kCurveRows));
}

TEST(ParameterCurves, RowsAreNamedByCurveLevelAndNumber) {
  EXPECT_EQ(table().rows[1].full_name(), "width_along[2].1");
  EXPECT_EQ(table().rows[14].full_name(), "crowd_along.7");
  EXPECT_EQ(table().find("width_along[2].3"), 3u);
  EXPECT_EQ(table().find_curve("width_along[2]")->first_row, 1u);
  EXPECT_EQ(table().find_curve("width_along"), nullptr);
  EXPECT_EQ(table().curve_of(0), nullptr);
  EXPECT_EQ(table().curve_of(1), &table().curves[0]);
  EXPECT_EQ(table().curve_of(7), &table().curves[0]);
  EXPECT_EQ(table().curve_of(8), &table().curves[1]);
  EXPECT_EQ(table().curve_of(14), &table().curves[1]);
}

TEST(ParameterCurves, FewerNumbersAreTheSameCurve) {
  const CurveInfo& curve = table().curves[0];
  for (const std::vector<double>& numbers : {std::vector<double>{3, 0, 8, 1}, {3, 0, 8, 1, 4}}) {
    ParameterValues values = table().defaults();
    set_curve(table(), curve, numbers, "", values);
    EXPECT_EQ(curve_in(curve, values).numbers, make_curve(numbers).numbers);
    EXPECT_EQ(values[0], table().defaults()[0]);
    EXPECT_EQ(values[curve.first_row + kCurveRows], 1);
  }
}

TEST(ParameterCurves, CoarseNumbersAreTheInverseOfRefining) {
  const CurveInfo& curve = table().curves[0];
  EXPECT_TRUE(rc::check([&] {
    const auto count = *rc::gen::element<std::size_t>(1, 4, 5, 7);
    std::vector<double> numbers;
    for (std::size_t i = 0; i < count; ++i) numbers.push_back(*rc::gen::inRange(0, 1001) * 0.01);
    ParameterValues values = table().defaults();
    set_curve(table(), curve, numbers, "", values);
    const std::vector<double> coarse = coarse_numbers(curve, values, count);
    RC_ASSERT(coarse.size() == count);
    for (std::size_t i = 0; i < count; ++i) RC_ASSERT(std::fabs(coarse[i] - numbers[i]) < 1e-12);
  }));
}

TEST(ParameterCurves, AConstantIsWrittenAsOneNumber) {
  ParameterValues values = table().defaults();
  set_curve(table(), table().curves[0], std::vector<double>{2.5}, "", values);
  EXPECT_EQ(shortest_numbers(table().curves[0], values), std::vector<double>{2.5});
  values[7] = 2;
  EXPECT_EQ(shortest_numbers(table().curves[0], values).size(), kCurveRows);
}

TEST(ParameterCurves, NeutralOnesAreNotInUse) {
  ParameterValues values = table().defaults();
  EXPECT_TRUE(is_neutral(table().curves[0], values));
  values[7] = 1.5;
  EXPECT_FALSE(is_neutral(table().curves[0], values));
  EXPECT_TRUE(is_neutral(table().curves[1], values));
  const std::vector<bool> in_use = rows_in_use(table(), values);
  for (std::size_t row = 0; row < in_use.size(); ++row) EXPECT_EQ(in_use[row], row < 8) << row;
}

TEST(ParameterCurves, RefusesAnotherCountOfNumbers) {
  for (const std::size_t count : {0, 2, 3, 6, 8})
    EXPECT_THAT(error_of("width_along[2]", std::vector<double>(count, 1.0)),
                HasSubstr(fmt::format(
                    "tree.toml:3: key 'width_along[2]': got {} numbers, expected 1, 4, 5 or 7", count)));
}

TEST(ParameterCurves, RefusesNumbersThatNoRowAccepts) {
  EXPECT_EQ(error_of("width_along[2]", {1, 1, -0.5, 1}),
            "tree.toml:3: key 'width_along[2]': got -0.5, expected a number 0..10");
  EXPECT_THAT(error_of("width_along[2]", {NAN}), HasSubstr("got nan, expected a number 0..10"));
}

TEST(ParameterCurves, RefusesADensityOfZeroEverywhere) {
  EXPECT_EQ(error_of("crowd_along", {0, 0, 0, 0}),
            "tree.toml:3: key 'crowd_along': got a density of 0 everywhere, expected a number above 0");
  EXPECT_EQ(error_of("crowd_along", {0, 0, 0.1, 0}), "no error");
  EXPECT_EQ(error_of("width_along[2]", {0}), "no error");
}

}  // namespace
}  // namespace espalier
