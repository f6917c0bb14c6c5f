// Two studies made by hand, whose differences are known; what cannot be compared is one clear line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include <espalier/core/error.h>
#include <espalier/experiments/comparison/compare_studies.h>

#include "support/run_espalier.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

struct HandMadeRun {
  std::string target, optimizer, seed;
  double iou = 0;
  std::string status = "done", objective = "iou";
};

fs::path study_of(const std::string& name, const std::vector<HandMadeRun>& runs) {
  const fs::path directory = fresh_folder("compare_" + name);
  std::ofstream(directory / "experiment.toml") << "[fits]\ntargets = ['x']\n";
  std::ofstream results(directory / "results.csv");
  results
      << "run,target,optimizer,objective,space,start,trained,seed,status,fitness,iou,tolerant_iou,outline_"
         "iou,unseen_iou,error\n";
  int count = 0;
  for (const HandMadeRun& run : runs) {
    const std::string values = run.status == "done"
                                   ? fmt::format("0.99,{},{},0.5,", run.iou, 0.5 + run.iou / 2)
                                   : std::string(",,,,");
    results << fmt::format("run{},{},{},{},default,auto,plain,{},{},{},\n", ++count, run.target,
                           run.optimizer, run.objective, run.seed, run.status, values);
  }
  return directory;
}

/// `targets` targets and two seeds; the second seed is `spread` better.
std::vector<HandMadeRun> runs_of(int targets, const std::string& optimizer, double gain, double spread = 0) {
  std::vector<HandMadeRun> runs;
  for (int i = 0; i < targets; ++i)
    for (int seed = 1; seed <= 2; ++seed)
      runs.push_back({fmt::format("t{}", i), optimizer, fmt::format("{}", seed),
                      0.5 + 0.01 * i + gain * (1 + 0.1 * i) + (seed == 2 ? spread : 0)});
  return runs;
}

std::string error_of(const fs::path& first, const fs::path& second) {
  try {
    compare_studies(first, second);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(CompareStudies, TargetsAreBlocksWithTheMeanOfTheirSeeds) {
  const StudyComparison comparison =
      compare_studies(study_of("a", runs_of(6, "ga", 0)), study_of("b", runs_of(6, "ga", 0.1, 0.02)));
  EXPECT_EQ(comparison.targets.size(), 6u);
  EXPECT_THAT(comparison.measures, ElementsAre("iou", "tolerant_iou", "outline_iou"));
  const CsvTable& table = comparison.table;
  ASSERT_EQ(table.rows.size(), 3u);
  EXPECT_EQ(table.text(0, "targets"), "6") << "seeds are no data sets";
  EXPECT_NEAR(table.number(0, "median_difference"), 0.1 * 1.25 + 0.01, 1e-9);
  EXPECT_NEAR(table.number(0, "p_value"), 2 / 64.0, 1e-6) << "all six signs alike";
  EXPECT_NEAR(table.number(0, "p_holm"), 3 * 2 / 64.0, 1e-6);
  EXPECT_EQ(table.number(0, "rank_biserial"), 1);
  EXPECT_LE(table.number(0, "lower_95"), table.number(0, "median_difference"));
  EXPECT_GE(table.number(0, "upper_95"), table.number(0, "median_difference"));
  EXPECT_EQ(table.number(2, "p_value"), 1) << "outlines are the same";
  EXPECT_EQ(table.number(2, "rank_biserial"), 0);
}

TEST(CompareStudies, TheOtherWayRoundTheDifferencesAreTheOpposite) {
  const fs::path a = study_of("a", runs_of(5, "ga", 0)), b = study_of("b", runs_of(5, "ga", 0.05));
  const CsvTable there = compare_studies(a, b).table, back = compare_studies(b, a).table;
  EXPECT_NEAR(there.number(0, "median_difference"), -back.number(0, "median_difference"), 1e-9);
  EXPECT_EQ(there.number(0, "rank_biserial"), -back.number(0, "rank_biserial"));
  EXPECT_EQ(there.number(0, "p_value"), back.number(0, "p_value"));
}

TEST(CompareStudies, MethodsOfOneNameAreComparedAndElseEachWithEach) {
  std::vector<HandMadeRun> two = runs_of(3, "ga", 0), other = runs_of(3, "cma_es", 0.1);
  two.insert(two.end(), other.begin(), other.end());
  const CsvTable shared = compare_studies(study_of("a", two), study_of("b", runs_of(3, "cma_es", 0))).table;
  ASSERT_EQ(shared.rows.size(), 3u);
  EXPECT_EQ(shared.text(0, "first"), "cma_es");
  const CsvTable each = compare_studies(study_of("a", two), study_of("b", runs_of(3, "SBPLX", 0))).table;
  EXPECT_EQ(each.rows.size(), 6u);
}

TEST(CompareStudies, AFailedRunCountsAsZero) {
  std::vector<HandMadeRun> runs = runs_of(4, "ga", 0);
  for (HandMadeRun& run : runs) run.status = run.target == "t0" ? "failed" : "done";
  const CsvTable table = compare_studies(study_of("a", runs_of(4, "ga", 0)), study_of("b", runs)).table;
  EXPECT_EQ(table.number(0, "rank_biserial"), -1);
  EXPECT_NEAR(table.number(0, "mean_first") - table.number(0, "mean_second"), 0.5 / 4, 1e-9);
}

TEST(CompareStudies, FitnessIsNoJudgeAndThePageSaysSo) {
  std::vector<HandMadeRun> runs = runs_of(3, "ga", 0);
  for (HandMadeRun& run : runs) run.objective = "dice";
  const StudyComparison comparison = compare_studies(study_of("a", runs_of(3, "ga", 0)), study_of("b", runs));
  EXPECT_THAT(comparison.measures, Not(testing::Contains("fitness")));
  EXPECT_THAT(comparison.objectives, ElementsAre("iou", "dice"));
  EXPECT_THAT(comparison_as_markdown(comparison),
              AllOf(HasSubstr("Compared by iou, tolerant_iou, outline_iou"), HasSubstr("(iou; dice)"),
                    HasSubstr("fall below 0.25")));
}

TEST(CompareStudies, RefusesWhatCannotBeCompared) {
  const fs::path a = study_of("a", runs_of(3, "ga", 0));
  std::vector<HandMadeRun> others = runs_of(3, "ga", 0);
  for (HandMadeRun& run : others) run.target = "other_" + run.target;
  EXPECT_THAT(error_of(a, study_of("b", others)),
              AllOf(HasSubstr("got the targets other_t0, other_t1, other_t2"), HasSubstr("t0, t1, t2")));
  std::vector<HandMadeRun> unfinished = runs_of(3, "ga", 0);
  unfinished.pop_back();
  EXPECT_THAT(error_of(a, study_of("c", unfinished)), HasSubstr("got 5 of 6 runs"));
  const fs::path growth = fresh_folder("compare_growth");
  std::ofstream(growth / "experiment.toml") << "[growth]\n";
  EXPECT_THAT(error_of(growth, a), HasSubstr("of [growth], expected one of [fits]"));
  EXPECT_THAT(error_of(a, growth / "none"), HasSubstr("experiment.toml"));
}

TEST(CompareStudies, RefusesAnotherMaskUnderTheSameName) {
  const fs::path a = study_of("a", runs_of(2, "ga", 0)), b = study_of("b", runs_of(2, "ga", 0));
  const auto write_mask = [](const fs::path& study, const char* run, const char* bytes) {
    fs::create_directories(study / "runs" / run);
    std::ofstream(study / "runs" / run / "target.png") << bytes;
  };
  write_mask(a, "run3", "mask");
  write_mask(b, "run4", "mask");
  EXPECT_EQ(error_of(a, b), "no error");
  write_mask(b, "run4", "another");
  EXPECT_THAT(error_of(a, b), HasSubstr("got another mask of target 't1'"));
}

TEST(CompareCommand, PrintsTheTableOrWritesIt) {
  const fs::path a = study_of("a", runs_of(3, "ga", 0)), b = study_of("b", runs_of(3, "ga", 0.1));
  const std::string arguments = "experiment compare '" + a.string() + "' '" + b.string() + "'";
  const ProgramRun printed = run_espalier(arguments);
  EXPECT_EQ(printed.exit_code, 0) << printed.err;
  EXPECT_THAT(printed.out, HasSubstr("| iou | ga | ga | 3 |"));
  const fs::path out = fresh_folder("compare_out") / "made";
  const ProgramRun written = run_espalier(arguments + " --out '" + out.string() + "'");
  EXPECT_EQ(written.exit_code, 0) << written.err;
  EXPECT_EQ(read_text_file(out / "compare.md"), printed.out);
  EXPECT_EQ(read_csv(out / "compare.csv").rows.size(), 3u);
}

TEST(CompareCommand, WithoutACommonTargetItEndsWithTwo) {
  const fs::path a = study_of("a", {{"x", "ga", "1", 0.5}}), b = study_of("b", {{"y", "ga", "1", 0.5}});
  expect_one_clear_error(run_espalier("experiment compare '" + a.string() + "' '" + b.string() + "' --out '" +
                                      (a / "out").string() + "'"));
  EXPECT_FALSE(fs::exists(a / "out"));
}

}  // namespace
}  // namespace espalier
