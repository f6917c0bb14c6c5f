// The history of a run as rows and as a chart.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

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
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 15) << line;
}

TEST(Trace, CountsEvaluationsAndBranchStepsApart) {
  Trace trace;
  add(trace, 0, {0.5, 0.2}, 0.2, true);
  trace.add_round(2, 70, 1.5, true, 0.1, {}, FitStage::branches);
  const std::string csv = trace_to_csv(trace.rows());
  EXPECT_THAT(csv, testing::StartsWith("evaluations,seconds,branch_steps,event,"));
  EXPECT_THAT(csv, testing::HasSubstr("\n2,0.500,0,improvement,"));
  EXPECT_THAT(csv, testing::HasSubstr("\n2,1.500,70,improvement,"));
}

TEST(Trace, OfNothingStillHasAChartOfEvaluations) {
  EXPECT_EQ(convergence_chart({}, "fitness").x_label, "evaluations");
}

TEST(Trace, TheChartSaysWhereStartsSearchAndRefinementEnd) {
  Trace trace;
  trace.add({0, std::vector<double>{0.5, 0.4}, 0.5, true, false}, 0.4, {}, FitStage::starts);
  trace.add({2, std::vector<double>{0.4, 0.3}, 0.5, true, false}, 0.3, {}, FitStage::species_space);
  trace.add({4, std::vector<double>{0.3, 0.2}, 0.5, true, false}, 0.2, {}, FitStage::search);
  const LineChart searched = convergence_chart(trace.rows(), "fitness");
  EXPECT_EQ(searched.x_label, "evaluations");
  ASSERT_EQ(searched.marks.size(), 2u);
  EXPECT_EQ(searched.marks[0].name, "starts end");
  EXPECT_EQ(searched.marks[0].x, 2);
  EXPECT_EQ(searched.marks[1].name, "search ends");
  EXPECT_EQ(searched.marks[1].x, 6);
  for (const FitStage stage : {FitStage::tracing, FitStage::branches, FitStage::finish})
    trace.add_round(6, 100, 0.5, true, 0.1, {}, stage);
  const LineChart refined = convergence_chart(trace.rows(), "fitness");
  EXPECT_EQ(refined.x_label, "evaluations, then branch steps");
  ASSERT_EQ(refined.marks.size(), 3u);
  EXPECT_EQ(refined.marks[2].name, "refinement ends");
  EXPECT_EQ(refined.marks[2].x, 106);
}

TEST(Trace, FitnessIsNamedByTheMeasuresItIsMadeOf) {
  EXPECT_EQ(fitness_in_words(parse_objective("iou"), ""), "fitness by iou");
  EXPECT_EQ(fitness_in_words(parse_objective("0.5*truncated_distance+0.5*iou"), ""),
            "fitness by 0.5 truncated_distance\n+ 0.5 iou");
  EXPECT_EQ(fitness_in_words(parse_objective("0.25*truncated_distance+0.15*iou+0.15*tolerant_iou+"
                                             "0.3*outline_iou+0.15*gap_iou"),
                             "prices"),
            "fitness by 0.25 truncated_distance\n+ 0.15 iou + 0.15 tolerant_iou\n"
            "+ 0.3 outline_iou + 0.15 gap_iou\nless prices");
}

}  // namespace
}  // namespace espalier
