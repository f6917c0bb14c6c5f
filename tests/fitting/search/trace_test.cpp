// The history of a run as rows, as a chart, and the chart's ticks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include <espalier/charts/chart_layout.h>
#include <espalier/fitting/search/trace.h>

namespace espalier {
namespace {

void add(Trace& trace, long first, std::vector<double> scores, double best, bool improved = false) {
  trace.add({first, scores, 0.5, improved, false}, best, {});
}

TEST(Trace, HasOneRowABatchWithItsBestMedianAndWorst) {
  Trace trace;
  add(trace, 0, {0.5, 0.2, 0.4}, 0.2, true);
  add(trace, 3, {0.9, 0.3, 0.6}, 0.2);
  ASSERT_EQ(trace.rows().size(), 2u);
  const TraceRow& row = trace.rows()[1];
  EXPECT_EQ(row.evaluations, 6);
  EXPECT_DOUBLE_EQ(row.best, 0.8);
  EXPECT_DOUBLE_EQ(row.batch_best, 0.7);
  EXPECT_DOUBLE_EQ(row.batch_median, 0.4);
  EXPECT_DOUBLE_EQ(row.batch_worst, 1 - 0.9);
}

TEST(Trace, GathersSingleEvaluationsUntilOneImproves) {
  Trace trace;
  for (long i = 0; i < 45; ++i) add(trace, i, {0.5}, 0.5);
  EXPECT_EQ(trace.rows().size(), 2u);
  add(trace, 45, {0.1}, 0.1, true);
  EXPECT_EQ(trace.rows().size(), 3u);
  EXPECT_EQ(trace.rows()[2].evaluations, 46);
}

TEST(Trace, CsvHasAsManyFieldsInEachLine) {
  Trace trace;
  add(trace, 0, {0.5, 0.2}, 0.2, true);
  std::istringstream csv(trace_to_csv(trace.rows()));
  for (std::string line; std::getline(csv, line);)
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 14) << line;
}

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
  const LineChart chart = convergence_chart({});
  EXPECT_THAT(chart_to_svg(chart), testing::HasSubstr("evaluations"));
  EXPECT_EQ(chart_to_picture(chart).width_px, 900);
}

TEST(Chart, DrawsALineInItsColourWhereTheAxesSay) {
  const Rgb red{255, 0, 0};
  const Picture picture = chart_to_picture({"x", "y", {{"line", red, 3, false, {{0, 0}, {10, 10}}}}});
  EXPECT_EQ(picture.at((96 + 900 - 24) / 2, (40 + 540 - 64) / 2), red);
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
