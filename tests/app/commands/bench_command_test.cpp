// `espalier bench`: its table, its report and ratios to an older one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "support/run_espalier.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(BenchCommand, ReportsEveryCaseOfASpecies) {
  const fs::path report = fresh_folder("bench") / "report.json";
  const fs::path plot = report.parent_path() / "plot.svg";
  const ProgramRun run = run_espalier("bench --species palm --seconds 0.01 --json '" + report.string() +
                                      "' --plot '" + plot.string() + "'");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("palm/256/leaves"));
  const auto json = nlohmann::json::parse(read_text_file(report));
  EXPECT_FALSE(json["machine"]["processor"].get<std::string>().empty());
  ASSERT_EQ(json["cases"].size(), 6u);
  for (const auto& c : json["cases"]) {
    EXPECT_GT(c["evaluations_per_second"], 0);
    EXPECT_GT(c["evaluations_per_second_all_threads"], 0);
    EXPECT_GT(c["grow_s"], 0);
    EXPECT_GT(c["draw_s"], 0);
    EXPECT_GT(c["bytes_per_thread"], 1000);
    EXPECT_LT(c["embree_differing_pixels"].get<double>(), 0.05 * c["set_pixels"].get<double>());
    EXPECT_EQ(c["leaves"].get<bool>(), c["mean_leaves"] > 0);
  }
  ASSERT_EQ(json["scaling"].size(), 4u);
  for (const auto& series : json["scaling"])
    for (const auto& point : series["points"]) EXPECT_GT(point[1], 0) << series["quantity"];
  EXPECT_GT(json["scaling"][0]["points"][4][0], 4 * json["scaling"][0]["points"][0][0].get<double>());
  EXPECT_THAT(read_text_file(plot), HasSubstr("stems, slope"));
}

TEST(BenchCommand, ComparesWithAnOlderReport) {
  const fs::path report = fresh_folder("bench_old") / "report.json";
  std::ofstream(report) << R"({"cases": [{"species": "palm", "size_px": 256, "leaves": true,
      "evaluations_per_second": 1e-3, "evaluations_per_second_all_threads": 1e-3}]})";
  const ProgramRun run =
      run_espalier("bench --species palm --seconds 0.01 --compare '" + report.string() + "'");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("new / old"));
  EXPECT_THAT(run.out, HasSubstr("geometric mean"));
}

TEST(BenchCommand, RefusesBadInputInOneLine) {
  const fs::path folder = fresh_folder("bench_bad");
  std::ofstream(folder / "text.json") << "not JSON";
  std::ofstream(folder / "other.json") << "{\"cases\": [1]}";
  for (const std::string arguments :
       {"--seconds 0", "--seconds nan", "--species oak", "--compare /nowhere.json"})
    expect_one_clear_error(run_espalier("bench " + arguments));
  for (const char* file : {"text.json", "other.json"})
    expect_one_clear_error(run_espalier("bench --compare '" + (folder / file).string() + "'"));
}

}  // namespace
}  // namespace espalier
