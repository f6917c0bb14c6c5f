// Laws of parameter tables: lookup, validation and the words of its messages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>

#include <espalier/core/error.h>
#include <espalier/core/parameter_table.h>

namespace espalier {
namespace {

ParameterInfo make_row(const char* name, int level, double lower, double upper, Scale scale) {
  ParameterInfo row;
  row.name = name;
  row.level = level;
  row.lower = row.default_value = lower;
  row.upper = upper;
  row.scale = scale;
  return row;
}

ParameterTable make_table() {
  ParameterTable table{"toy", {}};
  table.rows.push_back(make_row("size", -1, -1, 1, Scale::linear));
  table.rows.push_back(make_row("curve_res", 0, 1, 40, Scale::integer));
  table.rows.push_back(make_row("curve_res", 1, 1, 40, Scale::integer));
  table.rows.push_back(make_row("form", -1, 1, 3, Scale::choice));
  table.rows.back().choices = {"cherry", "orange", "magnolia"};
  table.rows.back().first_choice = 1;
  return table;
}

std::string message_for(const ParameterInfo& row, double value) {
  try {
    check_value(row, value, "my.toml:12");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ParameterTable, EveryRowIsFoundByItsFullName) {
  const ParameterTable table = make_table();
  for (std::size_t i = 0; i < table.rows.size(); ++i) EXPECT_EQ(table.find(table.rows[i].full_name()), i);
  EXPECT_EQ(table.rows[2].full_name(), "curve_res[1]");
}

TEST(ParameterTable, DefaultsFollowTheRows) {
  EXPECT_THAT(make_table().defaults(), testing::ElementsAre(-1, 1, 1, 1));
}

TEST(ParameterTable, UnknownNamesAreAnsweredWithTheClosest) {
  try {
    make_table().index_of("curve_rse[1]");
    FAIL() << "expected InputError";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("'curve_res[1]'"));
  }
}

TEST(CheckValue, AcceptsBothEndsAndNegativeZero) {
  const ParameterTable table = make_table();
  EXPECT_EQ(message_for(table.rows[0], -1), "");
  EXPECT_EQ(message_for(table.rows[0], 1), "");
  EXPECT_EQ(message_for(table.rows[0], -0.0), "");
}

TEST(CheckValue, RefusesWhatIsNotFinite) {
  for (const double value : {std::nan(""), std::numeric_limits<double>::infinity(),
                             -std::numeric_limits<double>::infinity(), 1e308})
    EXPECT_NE(message_for(make_table().rows[0], value), "") << value;
}

TEST(CheckValue, SaysWhereKeyGotAndExpected) {
  EXPECT_EQ(message_for(make_table().rows[2], 2.5),
            "my.toml:12: key 'curve_res[1]': got 2.5, expected a whole number 1..40");
  EXPECT_EQ(message_for(make_table().rows[3], 4),
            "my.toml:12: key 'form': got 4, expected one of cherry, orange, magnolia (or 1..3)");
}

TEST(CheckValue, RelaxableCountsMayBeFractions) {
  ParameterInfo row = make_table().rows[1];
  row.relaxable = true;
  EXPECT_EQ(message_for(row, 2.5), "");
  EXPECT_NE(message_for(row, 40.5), "");
}

TEST(CheckValue, RefusesTheNextNumberBeyondEitherEnd) {
  const ParameterInfo row = make_table().rows[0];
  EXPECT_NE(message_for(row, std::nextafter(row.lower, -2)), "");
  EXPECT_NE(message_for(row, std::nextafter(row.upper, 2)), "");
}

TEST(ParameterTable, PartsThatAPlantLacksAreNotInUse) {
  const ParameterTable table{"test",
                             {{.name = "a"},
                              {.name = "has_b", .part_of = "has_b"},
                              {.name = "b", .part_of = "has_b"},
                              {.name = "c"}}};
  EXPECT_EQ(rows_in_use(table, ParameterValues{0, 0, 5, 0}), (std::vector<bool>{true, false, false, true}));
  EXPECT_EQ(rows_in_use(table, ParameterValues{0, 2, 0, 0}), (std::vector<bool>{true, true, true, true}));
}

}  // namespace
}  // namespace espalier
