// Charts: round ticks, axes, lines and names, the same as pixels and as SVG.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include <espalier/charts/chart_layout.h>

namespace espalier {
namespace {

RC_GTEST_PROP(AxisTicks, AreRoundAndInside, ()) {
  const double lower = *rc::gen::inRange(-1000, 1000) * 0.37, span = *rc::gen::inRange(1, 1000) * 0.01;
  const auto ticks = axis_ticks(lower, lower + span, 6);
  RC_ASSERT(ticks.size() >= 2u && ticks.size() <= 13u);
  const double step = ticks[1] - ticks[0];
  const double leading = step / std::pow(10, std::floor(std::log10(step) + 1e-9));
  RC_ASSERT(std::fabs(leading - 1) < 1e-6 || std::fabs(leading - 2) < 1e-6 || std::fabs(leading - 5) < 1e-6);
  RC_ASSERT(ticks.front() >= lower - 1e-9 * step && ticks.back() <= lower + span + 1e-6 * step);
}

TEST(Chart, OfNothingStillHasAxes) {
  const LineChart chart{"evaluations", "fitness", {}};
  EXPECT_THAT(chart_to_svg(chart), testing::HasSubstr("evaluations"));
  EXPECT_EQ(chart_to_picture(chart).width_px, 900);
}

TEST(Chart, DrawsALineInItsColourWhereTheAxesSay) {
  const Rgb red{255, 0, 0};
  const Picture picture = chart_to_picture({"x", "y", {{"line", red, 3, false, {{0, 0}, {10, 10}}}}});
  EXPECT_EQ(picture.at((96 + 900 - 24) / 2, (40 + 540 - 64) / 2), red);
}

TEST(Chart, SvgHasOneElementAStrokeAndEscapesNames) {
  const LineChart chart{"x", "y", {{"a < b & c", {}, 2, false, {{0, 0}, {1, 1}}}}};
  const std::string svg = chart_to_svg(chart);
  EXPECT_THAT(svg, testing::HasSubstr("a &lt; b &amp; c"));
  EXPECT_THAT(svg, testing::Not(testing::HasSubstr("a < b")));
}

TEST(Chart, HigherValuesAreDrawnHigherUp) {
  const Rgb low{255, 0, 0}, high{0, 0, 255};
  const LineChart chart{"x", "y", {{"low", low, 3, true, {{5, 0}}}, {"high", high, 3, true, {{5, 9}}}}};
  float low_y = 0, high_y = 0;
  for (const ChartStroke& stroke : lay_out(chart).strokes)
    if (stroke.points.size() == 1) {
      float& y_px = stroke.color == low ? low_y : high_y;
      y_px = std::max(y_px, stroke.points[0].y_px);  // samples in the legend lie above the plot
    }
  EXPECT_LT(high_y, low_y - 100);
}

TEST(Chart, MarksAreLinesFromBottomToTopWithTheirNames) {
  LineChart chart{"x", "y", {{"line", {}, 2, false, {{0, 0}, {100, 1}}}}};
  chart.marks = {{"starts end", 1}, {"search ends", 2}, {"all ends", 100}};
  std::vector<ChartLabel> names;
  for (const ChartLabel& label : lay_out(chart).labels)
    if (label.upwards && label.anchor == TextAnchor::start) names.push_back(label);
  ASSERT_EQ(names.size(), 3u);
  EXPECT_EQ(names[0].text, "starts end");
  EXPECT_LT(names[1].at.y_px, names[0].at.y_px - text_width_px("starts end")) << "close marks share no place";
  EXPECT_EQ(names[2].at.y_px, names[0].at.y_px);
  EXPECT_LE(names[2].at.x_px, 900 - 7);
  int from_bottom_to_top = 0;
  for (const ChartStroke& stroke : lay_out(chart).strokes)
    from_bottom_to_top += stroke.points.size() == 2 && stroke.points[0].x_px == stroke.points[1].x_px &&
                          std::fabs(stroke.points[0].y_px - stroke.points[1].y_px) > 400;
  EXPECT_EQ(from_bottom_to_top, 3);
}

TEST(Chart, EachLineOfALabelHasItsRoomLeftOfTheAxis) {
  const auto axis_x = [](const std::string& label) {
    float x = 0;
    for (const ChartStroke& stroke : lay_out({"x", label, {}}).strokes)
      if (stroke.points.size() == 3) x = stroke.points[0].x_px;
    return x;
  };
  EXPECT_EQ(axis_x("one"), 96);
  EXPECT_EQ(axis_x("one\ntwo\nthree"), 96 + 2 * 20);
  const std::string svg = chart_to_svg({"x", "one\ntwo", {}});
  EXPECT_THAT(svg, testing::HasSubstr(">one</text>"));
  EXPECT_THAT(svg, testing::HasSubstr(">two</text>"));
}

TEST(Chart, LegendStaysInsideThePictureHoweverManyNames) {
  LineChart chart{"x", "y", {}};
  for (int i = 0; i < 7; ++i) chart.lines.push_back({std::string(20, 'n'), {}, 2, false, {{0, 0}, {1, 1}}});
  for (const ChartLabel& label : lay_out(chart).labels)
    if (label.anchor == TextAnchor::start) {
      EXPECT_LE(label.at.x_px + 12 * 20, 900);
      EXPECT_GE(label.at.y_px, 10);
    }
}

}  // namespace
}  // namespace espalier
