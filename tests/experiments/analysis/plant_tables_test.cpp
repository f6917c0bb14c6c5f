#include <gtest/gtest.h>

#include <espalier/experiments/analysis/plant_tables.h>

namespace espalier {
namespace {

const std::vector<std::string> kColumns{"run",
                                        "status",
                                        "target",
                                        "optimizer",
                                        "seed",
                                        "visible_wood",
                                        "depth_over_width",
                                        "leaves",
                                        "front_iou",
                                        "override_numbers",
                                        "side_iou",
                                        "sibling_front_iou",
                                        "sibling_side_iou"};

/// Two seeds of a leafy tree, one of a palm, and a run that failed.
CsvTable some_results() {
  return {kColumns,
          {{"a1", "done", "fir", "cma_es", "1", "0.1", "0.9", "1000", "0.8", "300", "0.7", "0.6", "0.6"},
           {"a2", "done", "fir", "cma_es", "2", "0.3", "1.3", "3000", "0.9", "500", "0.5", "0.6", "0.6"},
           {"b1", "done", "palm", "cma_es", "1", "0.5", "1", "200", "0.7", "0", "0.6", "0.5", "0.4"},
           {"b2", "failed", "palm", "cma_es", "2", "", "", "", "", "", "", "", ""}},
          "results.csv"};
}

TEST(PlantTable, SaysMediansAndTheExtremesOfEachGroup) {
  const CsvTable table = plant_table(some_results(), {{"leafy", {"fir"}}});
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0], (std::vector<std::string>{"all", "cma_es", "3", "0.300", "0.500", "0.900", "1.000",
                                                     "1.300", "1000", "300"}));
  EXPECT_EQ(table.rows[1], (std::vector<std::string>{"leafy", "cma_es", "2", "0.200", "0.300", "0.900",
                                                     "1.100", "1.300", "2000", "400"}));
}

TEST(PlantTable, HasNoRowsForResultsOfEarlierVersions) {
  const CsvTable old{{"run", "status", "target", "optimizer", "seed"}, {{"a", "done", "fir", "ga", "1"}}, ""};
  EXPECT_TRUE(plant_table(old, {}).rows.empty());
  EXPECT_TRUE(side_table(old).rows.empty());
}

TEST(SideTable, SubtractsTheSiblingsAndSaysHowSeedsDiffer) {
  const CsvTable table = side_table(some_results());
  ASSERT_EQ(table.rows.size(), 3u);
  // Gains of the side: .1 and -.1, whose deviation is .1·√2.
  EXPECT_EQ(table.rows[0], (std::vector<std::string>{"fir", "2", "0.850", "0.600", "0.600", "0.600", "0.250",
                                                     "0.000", "0.141"}));
  // One seed has no deviation.
  EXPECT_EQ(table.rows[1], (std::vector<std::string>{"palm", "1", "0.700", "0.500", "0.600", "0.400", "0.200",
                                                     "0.200", ""}));
  // Of the seeds: (.1 + .2) / 2 and -.1.
  EXPECT_EQ(table.rows[2].front(), "all");
  EXPECT_EQ(table.text(2, "runs"), "3");
  EXPECT_EQ(table.text(2, "side_gain"), "0.067");
  EXPECT_EQ(table.text(2, "side_gain_deviation"), "0.177");
}

TEST(SideTable, LeavesOutTargetsWhoseTreeIsNotKnown) {
  CsvTable results = some_results();
  for (auto& row : results.rows) row[10] = row[11] = row[12] = "";
  EXPECT_TRUE(side_table(results).rows.empty());
}

}  // namespace
}  // namespace espalier
