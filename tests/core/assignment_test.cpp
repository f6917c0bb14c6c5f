// name=value has one grammar: decimal numbers and names of choices, wherever it is read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include <espalier/core/assignment.h>
#include <espalier/core/error.h>

namespace espalier {
namespace {

using testing::HasSubstr;

const ParameterInfo kShape{.name = "leaf_shape",
                           .lower = 0,
                           .upper = 2,
                           .scale = Scale::choice,
                           .choices = {"round", "ovate", "oak"}};

template <typename Parse>
std::string error_of(Parse parse) {
  try {
    parse();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Assignment, SplitsAtTheFirstEqualsSign) {
  const Assignment assignment = parse_assignment("clip=a=b");
  EXPECT_EQ(assignment.name, "clip");
  EXPECT_EQ(assignment.value, "a=b");
}

TEST(Assignment, NeedsANameAndAnEqualsSign) {
  for (const char* text : {"", "levels", "=3"})
    EXPECT_THAT(error_of([&] { parse_assignment(text); }), HasSubstr("expected name=value")) << text;
}

RC_GTEST_PROP(Assignment, DecimalNumbersKeepTheirBits, (double value)) {
  RC_PRE(std::isfinite(value));
  RC_ASSERT(parse_decimal(fmt::format("{}", value)) == value);
}

TEST(Assignment, OnlyFiniteDecimalNumbersAreNumbers) {
  EXPECT_EQ(parse_decimal("+3"), 3.0);
  EXPECT_EQ(parse_decimal("-.5"), -0.5);
  for (const char* text : {"", "0x3", "0X3", "3 ", " 3", "3m", "nan", "inf", "1e999", "+-3", "--3"})
    EXPECT_FALSE(parse_decimal(text)) << text;
}

TEST(Assignment, AChoiceIsTakenByItsNameAndByItsNumber) {
  EXPECT_EQ(parse_parameter_value(kShape, "ovate"), 1.0);
  EXPECT_EQ(parse_parameter_value(kShape, "1"), 1.0);
  EXPECT_FALSE(std::signbit(parse_parameter_value(kShape, "-0")));
  for (const char* text : {"0x1", "elm", "3", "0.5", ""})
    EXPECT_THAT(error_of([&] { parse_parameter_value(kShape, text); }),
                HasSubstr(fmt::format("got '{}' for leaf_shape, expected one of round, ovate, oak", text)));
}

}  // namespace
}  // namespace espalier
