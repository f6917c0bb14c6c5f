// Every point of the box is a valid tree, and every tree in range has its point.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include <espalier/core/curves/curve.h>
#include <espalier/core/error.h>
#include <espalier/fitting/record/search_space.h>
#include <espalier/models/models.h>

namespace espalier {
namespace {

using testing::HasSubstr;

const ParameterTable& table() { return model_by_name("weber_penn").table(); }

SearchSpace space_of(const std::vector<std::string>& free, std::map<std::string, double> fixed = {}) {
  return make_search_space(table(), table().defaults(), {free, std::move(fixed)});
}

std::vector<double> random_unit(std::size_t dimension) {
  std::vector<double> unit;
  for (std::size_t i = 0; i < dimension; ++i) unit.push_back(*rc::gen::inRange(0, 1000001) * 1e-6);
  return unit;
}

std::string error_of(const SearchChoice& choice) {
  try {
    make_search_space(table(), table().defaults(), choice);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

RC_GTEST_PROP(SearchSpace, DecodesEveryPointOfTheBoxToValidValues, ()) {
  const SearchSpace space = space_of({"*"});
  ParameterValues values;
  space.decode(random_unit(space.dimension()), values);
  for (std::size_t i = 0; i < values.size(); ++i) {
    check_value(table().rows[i], values[i], "decode");
    RC_ASSERT(!(values[i] == 0 && std::signbit(values[i])));
  }
}

RC_GTEST_PROP(SearchSpace, EncodeIsTheInverseOfDecode, ()) {
  const SearchSpace space = space_of({"*"});
  ParameterValues values, again;
  space.decode(random_unit(space.dimension()), values);
  space.decode(space.encode(values), again);
  for (std::size_t i = 0; i < values.size(); ++i)
    RC_ASSERT(std::fabs(values[i] - again[i]) <= 1e-9 * std::max(1.0, std::fabs(values[i])));
}

std::vector<std::string> names_in(const SearchSpace& space) {
  std::vector<std::string> names;
  for (const FreeParameter& parameter : space.free) names.push_back(parameter.name);
  return names;
}

TEST(SearchSpace, ACurveIsFreeNumberByNumber) {
  const SearchSpace space = space_of({"length_along[1]"});
  ASSERT_EQ(space.dimension(), 7u);
  EXPECT_EQ(names_in(space).front(), "length_along[1].1");
  EXPECT_EQ(names_in(space).back(), "length_along[1].7");
}

TEST(SearchSpace, ACurveOfFourNumbersIsThatCurve) {
  const SearchSpace space = space_of({"g_scale", "length_along[1]~4", "ratio"});
  ASSERT_EQ(space.dimension(), 6u);
  EXPECT_EQ(space.free[2].name, "length_along[1]~4.1");
  ParameterValues values;
  space.decode(std::vector<double>{0.5, 0.5, 0.1, 0.9, 0.3, 0.7}, values);
  std::vector<double> numbers;
  for (std::size_t i = 0; i < 4; ++i)
    numbers.push_back(value_at(space.free[2 + i], std::vector{0.1, 0.9, 0.3, 0.7}[i]));
  const Curve curve = make_curve(numbers);
  const std::size_t first = table().index_of("length_along[1].1");
  for (std::size_t i = 0; i < 7; ++i) EXPECT_NEAR(values[first + i], curve.numbers[i], 1e-12) << i;
}

RC_GTEST_PROP(SearchSpace, CurvesOfFewerNumbersEncodeAsTheyDecode, ()) {
  const SearchSpace space = space_of({"*_along~4", "bend_along[2]~5", "radius_along[0]~1", "g_scale"});
  RC_ASSERT(space.dimension() == 1u + 21 * 4 + 5 + 1);
  const std::vector<double> unit = random_unit(space.dimension());
  ParameterValues values;
  space.decode(unit, values);
  for (std::size_t i = 0; i < values.size(); ++i) check_value(table().rows[i], values[i], "decode");
  const std::vector<double> again = space.encode(values);
  for (std::size_t i = 0; i < unit.size(); ++i) RC_ASSERT(std::fabs(unit[i] - again[i]) < 1e-9);
}

TEST(SearchSpace, PatternsReachCurvesOnlyWhereTheyNameThem) {
  for (const std::string& name : names_in(space_of({"*", "curve*", "*[1]"})))
    EXPECT_THAT(name, testing::Not(HasSubstr("_along")));
  EXPECT_EQ(space_of({"curve_along"}).dimension(), 28u);
  EXPECT_EQ(space_of({"*_along[1]"}).dimension(), 42u);
  EXPECT_EQ(space_of({"length_along[1].3"}).dimension(), 1u);
}

TEST(SearchSpace, RefusesFewerNumbersOfWhatIsNoCurve) {
  EXPECT_THAT(error_of({{"length[1]~4"}, {}}), HasSubstr("got 'length[1]~4', but length[1] is no curve"));
  EXPECT_THAT(error_of({{"length_along[1]~3"}, {}}),
              HasSubstr("got 'length_along[1]~3', expected a curve, ~ and 1, 4, 5 or 7 numbers"));
  EXPECT_THAT(error_of({{"length_along[7]"}, {}}), HasSubstr("the closest is 'length_along[1]'"));
}

TEST(SearchSpace, AFixedCurveIsHeldAsAWhole) {
  const SearchSpace space = space_of({"length_along[1]~4", "g_scale"}, {{"length_along[1]", 1.5}});
  EXPECT_EQ(space.dimension(), 1u);
  EXPECT_EQ(space.base[table().index_of("length_along[1].7")], 1.5);
}

TEST(SearchSpace, ClampsCoordinatesOutsideTheBox) {
  const SearchSpace space = space_of({"g_scale"});
  ParameterValues low, high;
  space.decode(std::vector<double>{-3.0}, low);
  space.decode(std::vector<double>{NAN}, high);
  EXPECT_EQ(low, high);
}

TEST(SearchSpace, MapsLogarithmicRowsSoThatTheMiddleIsTheGeometricMean) {
  const SearchSpace space = space_of({"ratio"});
  const FreeParameter& ratio = space.free[0];
  EXPECT_NEAR(value_at(ratio, 0.5), std::sqrt(ratio.lower * ratio.upper), 1e-12);
}

TEST(SearchSpace, GivesEachChoiceAnEqualSlice) {
  const FreeParameter shape = space_of({"shape"}).free[0];
  for (int slice = 0; slice < 9; ++slice) {
    EXPECT_EQ(value_at(shape, (slice + 0.01) / 9), slice);
    EXPECT_EQ(value_at(shape, (slice + 0.99) / 9), slice);
  }
  EXPECT_EQ(value_at(shape, 1), 8);
}

TEST(SearchSpace, GivesEachSignOfAFlagHalfTheBoxAndIsMonotoneInIt) {
  const FreeParameter down = space_of({"down_angle_v[1]"}).free[0];
  ASSERT_TRUE(down.split_at_zero);
  EXPECT_EQ(value_at(down, 0), -90);
  EXPECT_LT(value_at(down, 0.499), 0);
  EXPECT_EQ(value_at(down, 0.5), 0);
  EXPECT_EQ(value_at(down, 1), 60);
  for (double unit = 0; unit < 0.99; unit += 0.01)
    EXPECT_LT(value_at(down, unit), value_at(down, unit + 0.01));
}

TEST(SearchSpace, GivesEachWholeNumberOfASignedCountItsSlice) {
  const FreeParameter splits = space_of({"base_splits"}).free[0];
  for (int count = -3; count <= 3; ++count) EXPECT_EQ(value_at(splits, unit_at(splits, count)), count);
  EXPECT_EQ(value_at(splits, 0.49), -1);
  EXPECT_EQ(value_at(splits, 0.51), 0);
}

TEST(SearchSpace, RelaxesCountsButRoundsLevels) {
  EXPECT_EQ(space_of({"branches[1]"}).free[0].mapping, Mapping::linear);
  EXPECT_EQ(space_of({"levels"}).free[0].mapping, Mapping::whole);
}

TEST(SearchSpace, WidensARangeToHoldTheStart) {
  ParameterValues start = table().defaults();
  const std::size_t row = table().index_of("g_scale");
  start[row] = 77;
  const SearchSpace space = make_search_space(table(), start, {{"g_scale"}, {}});
  ParameterValues values;
  space.decode(space.encode(start), values);
  EXPECT_NEAR(values[row], 77, 1e-9);
}

TEST(SearchSpace, ScalesRangesInMetresWithTheTree) {
  const auto range = [](double factor) {
    return make_search_space(table(), table().defaults(), {{"leaf_scale"}, {}}, factor).free[0].upper;
  };
  EXPECT_DOUBLE_EQ(range(3), 3 * range(1));
}

TEST(SearchSpace, TakesWhatIsFixedOutOfTheSearch) {
  const SearchSpace space = space_of({}, {{"curve[1]", 33.0}});
  EXPECT_EQ(space.base[table().index_of("curve[1]")], 33);
  for (const FreeParameter& parameter : space.free) EXPECT_NE(parameter.name, "curve[1]");
}

TEST(SearchSpace, SearchesTheRowsFreeByDefaultUnlessTold) {
  std::size_t expected = 0;
  for (const ParameterInfo& row : table().rows) expected += row.free_by_default;
  EXPECT_EQ(space_of({}).dimension(), expected);
  EXPECT_EQ(space_of({"default", "shape"}).dimension(), expected + 1);
}

TEST(SearchSpace, PatternsNameLevelsAndGroups) {
  EXPECT_EQ(space_of({"curve"}).dimension(), 4u);
  EXPECT_EQ(space_of({"curve[2]"}).free[0].name, "curve[2]");
  EXPECT_EQ(space_of({"tropism_?"}).dimension(), 3u);
  EXPECT_EQ(space_of({"prune*"}).dimension(), 5u);
}

TEST(SearchSpace, SaysWhereAModelHasNothingToSearch) {
  ParameterTable table{"stick.lsys", {{.name = "unit", .role = {Role::length_unit}}}};
  const auto message = [&](const SearchChoice& choice) -> std::string {
    try {
      make_search_space(table, table.defaults(), choice, 1);
      return "no error";
    } catch (const FieldError& error) {
      return error.field;
    } catch (const InputError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(message({}),
            "stick.lsys: got a model without parameters to search, expected at least one, in an L-system a "
            "line such "
            "as 'param spread = 30 in 10 .. 60 deg'; its size alone is searched with --free unit");
  EXPECT_EQ(message({{"unit"}, {}}), "no error");
}

TEST(SearchSpace, NamesTheClosestParameterForUnknownNames) {
  EXPECT_THAT(error_of({{"g_scal"}, {}}), HasSubstr("closest is 'g_scale'"));
  EXPECT_THAT(error_of({{}, {{"ratoi", 1.0}}}), HasSubstr("closest is 'ratio'"));
}

TEST(SearchSpace, RefusesFixedValuesThatAreNotValid) {
  for (const double bad : {double(NAN), double(INFINITY), 1e308, -1.0})
    EXPECT_THAT(error_of({{}, {{"g_scale", bad}}}), HasSubstr("g_scale"));
  EXPECT_THAT(error_of({{}, {{"levels", 2.5}}}), HasSubstr("whole number"));
}

TEST(SearchSpace, RefusesToSearchNothing) {
  EXPECT_THAT(error_of({{"g_scale"}, {{"g_scale", 5.0}}}), HasSubstr("expected one left to search"));
}

TEST(SearchSpaceOf, PatternsMatchAsTheyAlwaysDid) {
  const auto count = [](const std::string& pattern) { return space_of({pattern}).free.size(); };
  EXPECT_EQ(count("length[1]"), 1u);
  EXPECT_EQ(count("l?ngth[1]"), 1u);
  EXPECT_EQ(count("*ngth[1]*"), 1u);
  EXPECT_EQ(count("l*n*t*1*"), count("l**n*t***1*"));
  EXPECT_EQ(count("*v[1]"), count("*?v[1]"));
  EXPECT_EQ(count("*[1]"), count("*?*[1]"));
  EXPECT_THROW(space_of({"length[1]?"}), FieldError);
  EXPECT_THROW(space_of({"?length[1]"}), FieldError);
}

/// Each star more doubled the time: thirty of them never ended.
TEST(SearchSpaceOf, PatternsOfManyStarsAreNoPuzzle) {
  std::string pattern;
  for (int i = 0; i < 300; ++i) pattern += "*?*";
  EXPECT_THROW(space_of({pattern + "!"}), FieldError);
}

}  // namespace
}  // namespace espalier
