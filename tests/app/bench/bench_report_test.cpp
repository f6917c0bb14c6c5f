// Reports of `espalier bench`: read as they were written, and ratios of the cases in both.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include <espalier/app/bench/bench_report.h>

#include "support/temporary_folders.h"

namespace espalier {
namespace {

BenchResult result_of(const std::string& species, double per_second) {
  BenchResult result;
  result.of.species = species;
  result.per_second = per_second;
  result.per_second_all_threads = per_second;
  return result;
}

TEST(BenchReport, IsReadAsItWasWritten) {
  const auto path = fresh_folder("bench_report") / "report.json";
  std::ofstream(path) << bench_to_json({result_of("palm", 12.5)}, {}, 2);
  const std::vector<OldBench> old = read_bench_json(path);
  ASSERT_EQ(old.size(), 1u);
  EXPECT_EQ(old[0].of.species, "palm");
  EXPECT_EQ(old[0].of.size_px, 256);
  EXPECT_TRUE(old[0].of.leaves);
  EXPECT_EQ(old[0].per_second, 12.5);
}

TEST(BenchReport, RatiosAreNewToOldOfTheCasesInBoth) {
  const std::vector<OldBench> old{{{"palm"}, 4, 4}, {{"acer"}, 1, 1}};
  const std::string ratios = bench_ratios({result_of("palm", 6), result_of("willow", 5)}, old);
  EXPECT_THAT(ratios, testing::HasSubstr("palm"));
  EXPECT_THAT(ratios, testing::HasSubstr("1.50"));
  EXPECT_THAT(ratios, testing::Not(testing::HasSubstr("willow")));
  EXPECT_THAT(ratios, testing::Not(testing::HasSubstr("acer")));
}

}  // namespace
}  // namespace espalier
