// Experiments as people write them: what is read, and one clear line with file and line for what is wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include <espalier/core/error.h>
#include <espalier/experiments/runner/experiment.h>
#include <espalier/experiments/runner/run_experiment.h>

#include "support/run_espalier.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

fs::path file_with(const std::string& text) {
  const fs::path path = fresh_folder("experiment") / "study.toml";
  std::ofstream(path) << text;
  return path;
}

std::string error_of(const std::string& text) {
  try {
    read_experiment(file_with(text));
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

const std::string kFits = "[fits]\ntargets = ['oc_palm']\nevaluations = 10\n";

TEST(ReadExperiment, EveryShippedExperimentReads) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(ESPALIER_SOURCE_DIR "/experiments")) {
    if (entry.path().extension() != ".toml" || entry.path().stem().extension() == ".expected") continue;
    EXPECT_NO_THROW(read_experiment(entry.path())) << entry.path();
    ++count;
  }
  EXPECT_GT(count, 5);
}

TEST(ReadExperiment, ListsMultiply) {
  const Experiment experiment = read_experiment(file_with(
      "[fits]\ntargets = ['oc_palm', 'fir']\noptimizers = ['cma_es', 'ga', {name = 'ga', population = 8}]\n"
      "objectives = ['iou', 'dice']\nspaces = ['default', {label = 'few', free = ['g_scale']}]\n"
      "starts = ['palm', 'auto']\nseeds = [4, 9, 2]\nevaluations = 10\n"));
  const Plan plan = plan_of(experiment, fresh_folder("plan"));
  EXPECT_EQ(plan.runs.size(), 2u * 3 * 2 * 2 * 2 * 3);
  std::set<std::string> names;
  for (const PlannedRun& run : plan.runs) names.insert(run.name);
  EXPECT_EQ(names.size(), plan.runs.size()) << "one directory a run";
}

TEST(ReadExperiment, AWholeNumberOfSeedsCountsFromOne) {
  EXPECT_EQ(read_experiment(file_with(kFits + "seeds = 3\n")).fits->seeds, (std::vector<Seed>{1, 2, 3}));
}

TEST(ReadExperiment, NamesFileLineAndWhatIsWrong) {
  EXPECT_THAT(error_of(kFits + "optimisers = ['ga']\n"), HasSubstr("study.toml:4: key 'optimisers'"));
  EXPECT_THAT(error_of(kFits + "optimizers = ['ga',\n'gaa']\n"), HasSubstr("study.toml:5"));
  EXPECT_THAT(error_of(kFits + "optimizers = [{name = 'ga', populaton = 3}]\n"), HasSubstr("population"));
  EXPECT_THAT(error_of("[fits]\ntargets = ['fir',\n\n'furr']\n"),
              HasSubstr("study.toml:4: key 'targets': got 'furr'"));
  EXPECT_THAT(error_of("[fits]\ntargets = []\n"),
              HasSubstr("study.toml:2: key 'targets': got an array of 0"));
  EXPECT_THAT(error_of("[fits]\ntargets = [{species = 'oak_of_nowhere'}]\n"), HasSubstr("study.toml:2"));
  EXPECT_THAT(error_of(kFits + "seeds = []\n"), HasSubstr("study.toml:4"));
  EXPECT_THAT(error_of(kFits + "seeds = [-1]\n"), HasSubstr("study.toml:4"));
  EXPECT_THAT(error_of(kFits + "seeds = 0\n"), HasSubstr("study.toml:4"));
  EXPECT_THAT(error_of(kFits + "objectives = ['iuo']\n"), HasSubstr("study.toml:4"));
  EXPECT_THAT(error_of(kFits + "spaces = [{free = ['g_scal']}]\n"), HasSubstr("g_scale"));
  EXPECT_THAT(error_of(kFits + "view = 'front'\n"), HasSubstr("study.toml:4"));
  EXPECT_THAT(error_of(kFits + "size = 3\n"), HasSubstr("study.toml:4: key 'size': got 3"));
  EXPECT_THAT(error_of(kFits + "seconds = nan\n"), HasSubstr("study.toml:4"));
  EXPECT_THAT(error_of("titel = 'x'\n" + kFits), HasSubstr("study.toml:1: key 'titel'"));
  EXPECT_THAT(error_of("title = 'x'\n"), HasSubstr("got 0 of the tables"));
  EXPECT_THAT(error_of(kFits + "[growth]\n"), HasSubstr("got 2 of the tables"));
  EXPECT_THAT(error_of("[growth]\nspecies = []\n"), HasSubstr("study.toml:2"));
  EXPECT_THAT(error_of("[pictures]\nspecies = 'palm'\ncolumns = [{set = {flaer = 1}}]\n"),
              HasSubstr("flare"));
  EXPECT_THAT(error_of("[pictures]\nspecies = 'palm'\ncolumns = [{prune_to = 'ball:1'}]\n"),
              HasSubstr("ball"));
  EXPECT_THAT(error_of("[fits\n"), HasSubstr("study.toml:1"));
  EXPECT_THAT(error_of("published_fitness = [2, 1]\n" + kFits), HasSubstr("study.toml:1"));
}

TEST(ReadExperiment, WordsAndCommentsDoNotMakeAnotherExperiment) {
  EXPECT_TRUE(same_runs(kFits, "# comment\ntitle = 'new'\n" + kFits));
  EXPECT_FALSE(same_runs(kFits, kFits + "seeds = 2\n"));
}

}  // namespace
}  // namespace espalier
