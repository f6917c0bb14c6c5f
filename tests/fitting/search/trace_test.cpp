// The history of a run as rows and as a chart.
#include <gtest/gtest.h>

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

TEST(Trace, OfNothingStillHasAChartOfEvaluations) { EXPECT_EQ(convergence_chart({}).x_label, "evaluations"); }

}  // namespace
}  // namespace espalier
