// Function files of vlab: both versions, and one fault a case.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include <espalier/core/curves/func_file.h>
#include <espalier/core/error.h>

namespace espalier {
namespace {

constexpr const char* kOld = "range: 0.0 1.0\npoints: 4\n0 1\n0.25 2\n0.5 0\n1 3\n";
constexpr const char* kNew =
    "fver 1 1\nname: bend\nsamples: 10\nflip: off\npoints: 5\n0.0 1 1\n0.2 2 1\n0.5 -1 1\n0.7 0 1\n1.0 3 1\n";

TEST(FuncFile, BothVersionsAreRead) {
  const std::vector<PlanePoint> old_points = read_func_points(kOld, "a.func"),
                                points = read_func_points(kNew, "b.func");
  ASSERT_EQ(old_points.size(), 4u);
  EXPECT_EQ(old_points[1].x, 0.25);
  EXPECT_EQ(old_points[2].y, 0);
  ASSERT_EQ(points.size(), 5u);
  EXPECT_EQ(points[2].y, -1);
}

TEST(FuncFile, APointMayCountSeveralTimes) {
  const std::string text =
      "fver 1 1\nname: x\nsamples: 2\nbackground: a.png\nflip: on\npoints: 4\n0 0\n0.5 1 3\n0.6 1\n1 0\n";
  const std::vector<PlanePoint> points = read_func_points(text, "a.func");
  ASSERT_EQ(points.size(), 6u);
  EXPECT_NEAR(func_value(points, 0.5), 1, 1e-9);  // a corner: the spline runs through a triple point
}

/// With x at the abscissae of Greville the spline's parameter is x: values are those of the polynomial.
TEST(FuncFile, ValuesAreThoseOfTheSpline) {
  const std::string text = "range: 0 1\npoints: 4\n0 1\n0.333333333333 2\n0.666666666667 -1\n1 3\n";
  const std::vector<PlanePoint> points = read_func_points(text, "a.func");
  for (const double x : {0.0, 0.1, 0.37, 0.5, 0.9, 1.0}) {
    const double s = 1 - x;
    EXPECT_NEAR(func_value(points, x), s * s * s + 3 * s * s * x * 2 - 3 * s * x * x + x * x * x * 3, 1e-9);
  }
  EXPECT_EQ(func_value(points, -1), 1);
  EXPECT_EQ(func_value(points, 2), 3);
}

/// Elsewhere too a value lies at its place: the curve of points whose y is x is x.
TEST(FuncFile, PlacesAreFoundWhereTheySay) {
  const std::vector<PlanePoint> points{{0, 0}, {0.1, 0.1}, {0.2, 0.2}, {0.9, 0.9}, {1, 1}};
  for (int i = 0; i <= 20; ++i) EXPECT_NEAR(func_value(points, i / 20.0), i / 20.0, 1e-12);
}

TEST(FuncFile, TheNearestCurveSaysHowFarItIs) {
  const std::vector<PlanePoint> points = read_func_points(kNew, "b.func");
  const NearestCurve nearest = nearest_curve(points, {-9, 9});
  EXPECT_EQ(nearest.curve.numbers.front(), 1);
  EXPECT_EQ(nearest.curve.numbers.back(), 3);
  EXPECT_GT(nearest.error, 0);
  EXPECT_LT(nearest.error, 0.15);
  for (int i = 0; i <= 50; ++i)
    EXPECT_LE(std::fabs(curve_value(nearest.curve, i / 50.0) - func_value(points, i / 50.0)),
              nearest.error + 1e-12);
}

TEST(FuncFile, ItsNumbersStayInTheirBounds) {
  const std::vector<PlanePoint> points =
      read_func_points("range: 0 1\npoints: 4\n0 0\n0.2 0\n0.5 0\n1 5\n", "a.func");
  EXPECT_EQ(func_range(points).lower, 0);
  EXPECT_EQ(func_range(points).upper, 5);
  const NearestCurve free = nearest_curve(points, {-9, 9}), bound = nearest_curve(points, {0, 5});
  const auto least = [](const Curve& curve) {
    return *std::min_element(curve.numbers.begin(), curve.numbers.end());
  };
  EXPECT_LT(least(free.curve), 0);
  EXPECT_EQ(least(bound.curve), 0);
  EXPECT_LT(bound.error, 0.05);
}

struct FuncFault {
  const char* text;
  const char* expected;
};
class FuncFaults : public testing::TestWithParam<FuncFault> {};

TEST_P(FuncFaults, AreRefusedWithTheirLine) {
  try {
    read_func_points(GetParam().text, "bad.func");
    FAIL() << GetParam().text;
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(GetParam().expected));
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, FuncFaults,
    testing::Values(
        FuncFault{"", "bad.func:1: got the end of the file, expected 'fver 1 1'"},
        FuncFault{"fver 2 0\n", "bad.func:1: got 'fver 2 0', expected 'fver 1 1' or 'range: 0 1'"},
        FuncFault{"fver 1 2\nname: x\n", "bad.func:1: got 'fver 1 2'"},
        FuncFault{"funcgalleryver 1 1\nitems: 1\n", "bad.func:1: got 'funcgalleryver 1 1'"},
        FuncFault{"range: 0 2\npoints: 4\n", "bad.func:1: got 'range: 0 2'"},
        FuncFault{"range: 0 1\npoints: 3\n0 0\n0.5 0\n1 0\n",
                  "bad.func:2: got 'points: 3', expected 'points:' and a whole number 4..1000"},
        FuncFault{"range: 0 1\npoints: 4\n0 0\n0.5 nan\n0.7 1\n1 0\n",
                  "bad.func:4: got '0.5 nan', expected a point: finite numbers"},
        FuncFault{"range: 0 1\npoints: 4\n0 0\n0.5 1e999\n0.7 1\n1 0\n", "bad.func:4: got '0.5 1e999'"},
        FuncFault{"range: 0 1\npoints: 4\n0 0\n0.5 0\n0.4 0\n1 0\n",
                  "bad.func:5: got '0.4 0', expected a point with x from 0.5"},
        FuncFault{"range: 0 1\npoints: 4\n0.1 0\n0.5 0\n0.6 0\n1 0\n",
                  "bad.func:3: got '0.1 0', expected a first point at x = 0"},
        FuncFault{"range: 0 1\npoints: 4\n0 0\n0.5 0\n0.6 0\n0.9 0\n",
                  "bad.func:6: got '0.9 0', expected a last point at x = 1"},
        FuncFault{"range: 0 1\npoints: 4\n0 0\n0.5 0\n",
                  "bad.func:4: got the end of the file, expected a point"},
        FuncFault{"range: 0 1\npoints: 4\n0 0\n0.5 0\n0.6 0\n1 0\n1 0\n",
                  "bad.func:7: got '1 0', expected the end of the file after 4 points"},
        FuncFault{"fver 1 1\npoints: 4\n0 0\n0.5 0 1.5\n0.6 0\n1 0\n",
                  "bad.func:4: got '0.5 0 1.5', expected a point that counts 1 to 10"},
        FuncFault{"fver 1 1\npoints: 4\n0 0 a\n0.5 0 1\n0.6 0\n1 0\n",
                  "bad.func:3: got '0 0 a', expected a point"}));

}  // namespace
}  // namespace espalier
