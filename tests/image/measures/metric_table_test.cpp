// Laws of every row of the table of measures, of those to come too, and of the JSON made from it.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include <espalier/image/measures/compare.h>
#include <espalier/image/measures/metrics_json.h>
#include <espalier/image/measures/objective.h>

#include "support/random_masks.h"

namespace espalier {
namespace {

using test::draw_mask;
using test::draw_pair;

RC_GTEST_PROP(MetricTable, EveryMeasureIsBetweenZeroAndOne, ()) {
  const auto [a, b] = draw_pair(150);
  for (const double value : compare_masks(a, b).values) RC_ASSERT(value >= 0.0 && value <= 1.0);
}

RC_GTEST_PROP(MetricTable, IdenticalMasksAreTheBest, ()) {
  const Mask mask = draw_mask(150);
  const MaskMetrics metrics = compare_masks(mask, mask);
  for (std::size_t row = 0; row < kMetricCount; ++row)
    RC_ASSERT(dissimilarity_of(kMetrics[row], metrics.values[row]) == 0.0);
}

RC_GTEST_PROP(MetricTable, AnObjectiveOfOneTermIsTheMeasureTurnedToZeroIsBest, ()) {
  const auto [a, b] = draw_pair(100);
  const MaskMetrics metrics = compare_masks(a, b);
  for (std::size_t row = 0; row < kMetricCount; ++row)
    if (kMetrics[row].in_objective)
      RC_ASSERT(dissimilarity(parse_objective(kMetrics[row].name), a, b) ==
                dissimilarity_of(kMetrics[row], metrics.values[row]));
}

TEST(MetricTable, EachNameIsGivenOnceAndEveryRowHasHelpOfOneLine) {
  std::set<std::string> names;
  for (const Metric& metric : kMetrics) {
    EXPECT_TRUE(names.insert(metric.name).second) << metric.name;
    if (metric.also_called) {
      EXPECT_TRUE(names.insert(metric.also_called).second) << metric.also_called;
    }
    EXPECT_FALSE(std::string(metric.help).empty()) << metric.name;
    EXPECT_EQ(std::string(metric.help).find('\n'), std::string::npos) << metric.name;
  }
}

TEST(MetricTable, ANameIsTheValueOfItsRow) {
  MaskMetrics metrics;
  for (std::size_t row = 0; row < kMetricCount; ++row) metrics.values[row] = static_cast<double>(row);
  EXPECT_STREQ(kMetrics[static_cast<std::size_t>(metrics["gap_iou"])].name, "gap_iou");
  EXPECT_STREQ(kMetrics[static_cast<std::size_t>(metrics["iou"])].name, "iou");
}

TEST(MetricsJson, GoesThereAndBackInTheOrderOfTheTable) {
  MaskMetrics metrics;
  for (std::size_t row = 0; row < kMetricCount; ++row) metrics.values[row] = 0.1 * static_cast<double>(row);
  const nlohmann::ordered_json json = metrics;
  ASSERT_EQ(json.size(), kMetricCount);
  EXPECT_EQ(json.begin().key(), kMetrics[0].name);
  EXPECT_EQ(json.get<MaskMetrics>().values, metrics.values);
}

TEST(MetricsJson, AMeasureThatAFileLacksIsUnknownAndIsNotWrittenAgain) {
  const auto metrics = nlohmann::json::parse(R"({"iou": 0.5})").get<MaskMetrics>();
  EXPECT_EQ(metrics["iou"], 0.5);
  EXPECT_TRUE(std::isnan(metrics["dice"]));
  EXPECT_EQ(nlohmann::ordered_json(metrics).dump(), R"({"iou":0.5})");
}

}  // namespace
}  // namespace espalier
