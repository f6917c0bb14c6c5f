// Curves in space as a few points: their refinement, their length, their fit to a line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include <espalier/core/curves/axis.h>
#include <espalier/core/error.h>

namespace espalier {
namespace {

AxisPoint any_point() {
  const auto number = [] { return *rc::gen::inRange(-1000, 1001) / 1000.0; };
  return {number(), number(), number()};
}

/// The last one stands off, so that they are not all the same.
std::vector<AxisPoint> any_points(std::size_t count) {
  std::vector<AxisPoint> points;
  for (std::size_t i = 0; i < count; ++i) points.push_back(any_point());
  points.back() = points.front() + AxisPoint{0, 1, 0};
  return points;
}

std::size_t any_count() { return *rc::gen::elementOf(std::vector(kAxisCounts.begin(), kAxisCounts.end())); }

bool near(AxisPoint a, AxisPoint b, double tolerance) { return length(a - b) <= tolerance; }

/// Bernstein's polynomials: of three points after the base the spline is one cubic Bézier curve.
AxisPoint bezier(const std::vector<AxisPoint>& p, double u) {
  const double v = 1 - u;
  return p[0] * (3 * v * v * u) + p[1] * (3 * v * u * u) + p[2] * (u * u * u);
}

RC_GTEST_PROP(AxisCurve, OfThreePointsIsABezierCurve, ()) {
  const std::vector<AxisPoint> points = any_points(3);
  const AxisCurve axis = make_axis(points);
  for (int i = 0; i <= 10; ++i) RC_ASSERT(near(axis_point(axis, i / 10.0), bezier(points, i / 10.0), 1e-12));
}

RC_GTEST_PROP(AxisCurve, BeginsAtTheOriginAndEndsAtItsLastPoint, ()) {
  const std::vector<AxisPoint> points = any_points(any_count());
  const AxisCurve axis = make_axis(points);
  RC_ASSERT(axis_point(axis, 0) == AxisPoint{});
  RC_ASSERT(near(axis_point(axis, 1), points.back(), 1e-12));
}

/// Points on the spline of few points, and the least squares of more: that they agree needs an exact
/// refinement.
RC_GTEST_PROP(AxisCurve, IsAmongThoseOfMorePoints, ()) {
  const std::vector<AxisPoint> points = any_points(any_count());
  const AxisCurve axis = make_axis(points);
  std::vector<AxisPoint> line;
  for (int i = 0; i <= 60; ++i) line.push_back(axis_point(axis, i / 60.0));
  for (const std::size_t count : kAxisCounts) {
    if (count < points.size()) continue;
    const std::vector<AxisPoint> fitted = fit_axis(line, count);
    const AxisCurve refined = make_axis(fitted);
    for (std::size_t i = 0; i < kAxisPoints; ++i) RC_ASSERT(near(refined.points[i], axis.points[i], 1e-9));
    for (std::size_t i = 0; i < points.size() && count == points.size(); ++i)
      RC_ASSERT(near(fitted[i], points[i], 1e-9));
  }
}

RC_GTEST_PROP(AxisCurve, ItsSlopeIsItsDerivative, ()) {
  const AxisCurve axis = make_axis(any_points(any_count()));
  constexpr double kStep = 1e-5;
  for (int i = 1; i < 20; ++i) {
    const double u = i / 20.0 + 1e-3;  // not at a knot
    const AxisPoint difference = axis_point(axis, u + kStep) - axis_point(axis, u - kStep);
    RC_ASSERT(near(axis_slope(axis, u), difference * (0.5 / kStep), 1e-5));
  }
}

RC_GTEST_PROP(AxisArcs, LengthIsThatOfAFinePolyline, ()) {
  const AxisCurve axis = make_axis(any_points(any_count()));
  const AxisArcs arcs(axis);
  constexpr int kParts = 4000;
  double sum = 0;
  for (int i = 0; i < kParts; ++i)
    sum += length(axis_point(axis, (i + 1.0) / kParts) - axis_point(axis, i * 1.0 / kParts));
  RC_ASSERT(std::fabs(arcs.length() - sum) < 0.005 * sum);
}

RC_GTEST_PROP(AxisArcs, APlaceHasItsShareOfTheLengthBehindIt, ()) {
  const AxisCurve axis = make_axis(any_points(any_count()));
  const AxisArcs arcs(axis);
  constexpr int kParts = 2000;
  const double place = arcs.place_at(0.37);
  double sum = 0;
  for (int i = 0; i < kParts; ++i)
    sum += length(axis_point(axis, place * (i + 1) / kParts) - axis_point(axis, place * i / kParts));
  RC_ASSERT(std::fabs(sum / arcs.length() - 0.37) < 0.02);
  RC_ASSERT(arcs.place_at(0) == 0 && arcs.place_at(1) == 1);
}

/// Three points at the base: the derivative is 0 there.
TEST(AxisArcs, HasADirectionWhereItsPointsLieOnEachOther) {
  const std::vector<AxisPoint> points{{0, 0, 0}, {0, 0, 0}, {2, 0, 0}};
  const AxisCurve axis = make_axis(points);
  EXPECT_TRUE(near(AxisArcs(axis).direction(0), {1, 0, 0}, 1e-9));
  EXPECT_TRUE(near(AxisArcs(axis).direction(0.7), {1, 0, 0}, 1e-9));
}

struct BadPoints {
  const char* name;
  std::vector<AxisPoint> points;
  const char* message;
};

class BadAxis : public testing::TestWithParam<BadPoints> {};

TEST_P(BadAxis, IsRefused) {
  try {
    make_axis(GetParam().points);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(GetParam().message));
  }
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
INSTANTIATE_TEST_SUITE_P(
    All, BadAxis,
    testing::Values(BadPoints{"None", {}, "got 0 points"}, BadPoints{"One", {{0, 0, 1}}, "got 1 points"},
                    BadPoints{"Two", {{0, 0, 1}, {0, 0, 2}}, "got 2 points"},
                    BadPoints{"Five", std::vector<AxisPoint>(5, AxisPoint{0, 0, 1}),
                              "expected 3, 4, 6 or 10"},
                    BadPoints{"Far", {{0, 0, 1}, {0, 0, 2}, {0, 1e6, 2}}, "got the number 1000000"},
                    BadPoints{"Nan", {{0, 0, 1}, {kNan, 0, 2}, {0, 0, 2}}, "got the number nan"},
                    BadPoints{"AllTheSame", std::vector<AxisPoint>(4, AxisPoint{0, 0, 1}), "all the same"},
                    BadPoints{"AllAtTheBase", std::vector<AxisPoint>(3), "all the same"}),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace espalier
