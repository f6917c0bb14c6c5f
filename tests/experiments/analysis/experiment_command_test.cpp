// espalier experiment as a user meets it: runs that survive being killed at any moment, failed runs as rows,
// reports, and expectations that can be broken.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>

#include <fstream>
#include <map>
#include <random>

#include <espalier/experiments/runner/csv.h>

#include "support/run_espalier.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string kQuick = ESPALIER_SOURCE_DIR "/experiments/quick.toml";

fs::path file_with(const std::string& name, const std::string& text) {
  const fs::path path = fresh_folder("file_" + name) / name;
  std::ofstream(path) << text;
  return path;
}

/// Runs of a few hundred evaluations: a second or two in all.
fs::path small_study() {
  return file_with(
      "study.toml",
      "[fits]\ntargets = ['oc_palm', {species = 'palm', seed = 3}]\noptimizers = ['cma_es', 'LN_SBPLX']\n"
      "starts = ['palm']\nexclude_truth = false\nseeds = 2\nevaluations = 200\nsize = 32\nmax_stems = 300\n"
      "max_leaves = 3000\nunseen_seeds = 2\nsiblings = 2\n");
}

std::string run_arguments(const fs::path& file, const fs::path& out) {
  return "experiment run '" + file.string() + "' --out '" + out.string() + "' --quiet";
}

/// The small study, run once for all who only look at it, or run it again where it is done.
const fs::path& finished_study() {
  static const fs::path out = [] {
    const fs::path made = fresh_folder("finished") / "out";
    EXPECT_EQ(run_espalier(run_arguments(small_study(), made) + " --jobs 1").exit_code, 0);
    return made;
  }();
  return out;
}

/// The report with its tables and its page, as where there is no Matplotlib: drawing takes seconds.
ProgramRun report_without_plots(const fs::path& out) {
  const fs::path stub = fresh_folder("no_matplotlib");
  std::ofstream(stub / "matplotlib.py") << "raise ImportError('not installed')\n";
  return run_shell("PYTHONPATH='" + stub.string() + "' '" ESPALIER_PROGRAM "' experiment report '" +
                   out.string() + "'");
}

void expect_error(const std::string& arguments, const std::string& words) {
  const ProgramRun run = run_espalier(arguments);
  expect_one_clear_error(run);
  EXPECT_THAT(run.err, HasSubstr(words)) << arguments;
}

TEST(ExperimentCommand, KilledTenTimesItEndsWithTheTableOfTheUnbrokenRun) {
  const fs::path study = small_study(), folder = fresh_folder("kill"), unbroken = finished_study();
  std::mt19937 random(std::random_device{}());
  const fs::path broken = folder / "broken";
  int kills = 0;
  for (int attempt = 0; attempt < 10; ++attempt)
    kills += WIFSIGNALED(
        run_and_signal(run_arguments(study, broken), 30 + static_cast<int>(random() % 170), SIGKILL));
  EXPECT_GT(kills, 0) << "no execution lived long enough to be killed";
  ASSERT_EQ(run_espalier(run_arguments(study, broken)).exit_code, 0);
  EXPECT_EQ(read_text_file(broken / "results.csv"), read_text_file(unbroken / "results.csv"));
}

TEST(ExperimentCommand, TheNumberOfJobsChangesNothing) {
  const fs::path one = finished_study(), three = fresh_folder("jobs") / "3";
  ASSERT_EQ(run_espalier(run_arguments(small_study(), three) + " --jobs 3").exit_code, 0);
  EXPECT_EQ(read_text_file(one / "results.csv"), read_text_file(three / "results.csv"));
}

TEST(ExperimentCommand, RunsThatAreDoneAreNotRunAgain) {
  const fs::path out = finished_study();
  const std::string times = read_text_file(out / "times.csv");
  ASSERT_NE(times, "");
  ASSERT_EQ(run_espalier(run_arguments(small_study(), out)).exit_code, 0);
  EXPECT_EQ(read_text_file(out / "times.csv"), times) << "wall times would differ";
}

/// The small study with other lists.
fs::path grown_study(const std::string& targets, const std::string& optimizers, const std::string& seeds,
                     const std::string& more = "") {
  return file_with("study.toml", "[fits]\ntargets = [" + targets + "]\noptimizers = [" + optimizers +
                                     "]\nseeds = " + seeds +
                                     "\nstarts = ['palm']\nevaluations = 40\nsize = 32\nmax_stems = 300\n"
                                     "max_leaves = 3000\n" +
                                     more);
}

/// The files that runs left, by the labels of their rows.
std::map<std::string, std::string> results_by_labels(const fs::path& out) {
  const CsvTable results = read_csv(out / "results.csv");
  std::map<std::string, std::string> files;
  for (std::size_t row = 0; row < results.rows.size(); ++row) {
    const fs::path run = out / "runs" / results.text(row, "run");
    std::string& text =
        files[results.text(row, "target") + results.text(row, "optimizer") + results.text(row, "seed")];
    for (const char* file : {"row.json", "summary.json", "trace.csv"}) text += read_text_file(run / file);
  }
  return files;
}

TEST(ExperimentCommand, AFinishedStudyTakesMoreSeedsTargetsAndMethods) {
  const fs::path out = fresh_folder("grow") / "out", fresh = fresh_folder("grow_fresh") / "out";
  const fs::path small = grown_study("'oc_palm'", "'cma_es'", "[2]");
  ASSERT_EQ(run_espalier(run_arguments(small, out)).exit_code, 0);
  const auto before = results_by_labels(out);
  const fs::path large = grown_study("'oc_evergreen', 'oc_palm'", "'LN_SBPLX', 'cma_es'", "2");
  const ProgramRun run = run_espalier(run_arguments(large, out));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto after = results_by_labels(out);
  EXPECT_EQ(after.size(), 8u);
  ASSERT_EQ(before.size(), 1u);
  EXPECT_EQ(after.at("oc_palmcma_es2"), before.at("oc_palmcma_es2")) << "wall times would differ";
  ASSERT_EQ(run_espalier(run_arguments(large, fresh)).exit_code, 0);
  EXPECT_EQ(read_text_file(out / "results.csv"), read_text_file(fresh / "results.csv"));
  EXPECT_EQ(report_without_plots(out).exit_code, 0);
  EXPECT_EQ(read_text_file(out / "experiment.toml"), read_text_file(large));
}

TEST(ExperimentCommand, AMovedStudyWhosePictureIsGoneEndsAsIfItHadNotBeen) {
  const fs::path folder = fresh_folder("moved"), picture = folder / "tree.png", whole = folder / "whole";
  fs::copy_file(ESPALIER_SOURCE_DIR "/targets/oc_palm.png", picture);
  const fs::path study = grown_study("'" + picture.string() + "', {species = 'palm', seed = 3}", "'cma_es'",
                                     "2", "exclude_truth = false\n");
  ASSERT_EQ(run_espalier(run_arguments(study, whole)).exit_code, 0);
  const std::string results = read_text_file(whole / "results.csv");
  EXPECT_FALSE(fs::exists(whole / "runs/tree-1/picture.png")) << "one copy is enough";
  const fs::path moved = folder / "far" / "study", run = moved / "runs/tree-2";
  fs::create_directory(folder / "far");
  fs::rename(whole, moved);
  fs::remove(picture);
  fs::remove_all(run);
  for (const char* done : {"tree-1", "palm-1"})  // they are gone on with
    ASSERT_TRUE(fs::remove(moved / "runs" / done / "row.json"));
  ASSERT_EQ(run_espalier(run_arguments(moved / "experiment.toml", moved)).exit_code, 0);
  EXPECT_EQ(read_text_file(moved / "results.csv"), results);
  const fs::path again = folder / "again";
  ASSERT_EQ(
      run_espalier("fit --quiet --repeat '" + run.string() + "' --out '" + again.string() + "'").exit_code,
      0);
  EXPECT_EQ(read_text_file(again / "best.toml"), read_text_file(run / "best.toml"));
  EXPECT_TRUE(fs::exists(again / "picture.png")) << "it is a run of its own";
  fs::copy_file(ESPALIER_SOURCE_DIR "/targets/fir.png", picture);
  expect_error(run_arguments(study, moved), "tree.png: got another picture than ");
}

TEST(ExperimentCommand, AStudyKilledWhileItGrowsEndsAsIfItHadNotBeen) {
  const fs::path folder = fresh_folder("grow_kill"), out = folder / "out";
  ASSERT_EQ(run_espalier(run_arguments(grown_study("'oc_palm'", "'cma_es'", "3"), out)).exit_code, 0);
  const fs::path large = grown_study("'oc_palm', 'oc_evergreen'", "'cma_es', 'LN_SBPLX'", "4");
  int kills = 0;
  for (int attempt = 0; attempt < 5; ++attempt)
    kills += WIFSIGNALED(run_and_signal(run_arguments(large, out), 350 + 30 * attempt, SIGKILL));
  EXPECT_GT(kills, 0);
  ASSERT_EQ(run_espalier(run_arguments(large, out)).exit_code, 0);
  ASSERT_EQ(run_espalier(run_arguments(large, folder / "unbroken")).exit_code, 0);
  EXPECT_EQ(read_text_file(out / "results.csv"), read_text_file(folder / "unbroken" / "results.csv"));
}

TEST(ExperimentCommand, WhatWouldChangeRunsIsRefusedByItsKey) {
  const fs::path out = fresh_folder("grow_refused") / "out";
  ASSERT_EQ(run_espalier(run_arguments(grown_study("'oc_palm'", "'cma_es'", "2"), out)).exit_code, 0);
  const std::string results = read_text_file(out / "results.csv");
  const auto refused = [&](const fs::path& study, const std::string& words) {
    expect_error(run_arguments(study, out), words);
    EXPECT_EQ(read_text_file(out / "results.csv"), results);
  };
  refused(grown_study("'oc_palm'", "'cma_es'", "1"), "seeds: got none that is '2'");
  refused(grown_study("'oc_evergreen'", "'cma_es'", "2"), "targets: got none that is 'oc_palm'");
  refused(grown_study("'oc_palm'", "'cma_es'", "2", "kind = 'palm'\n"), "kind: got palm, expected any");
  refused(grown_study("'oc_palm'", "'cma_es'", "2", "objectives = ['iou']\n"), "objectives: got none");
  refused(grown_study("'oc_palm'", "{name = 'ga', label = 'cma_es'}", "2"), "optimizers: got {name = ga}");
  expect_error(run_arguments(grown_study("'oc_palm'", "'cma_es'", "2"), out) + " --set evaluations=30",
               "evaluations: got 30, expected 40");
}

TEST(ExperimentCommand, ASheetThatGrowsKeepsItsPicturesAtTheirPlaces) {
  const auto sheet = [](const std::string& columns) {
    return file_with("sheet.toml", "[pictures]\nspecies = 'palm'\nsize = 32\ncolumns = [" + columns + "]\n");
  };
  const std::string a = "{label = 'a', set = {flare = 2}}", b = "{label = 'b', set = {leaf_blos_num = 0}}";
  const fs::path out = fresh_folder("grow_sheet") / "out", runs = out / "runs";
  ASSERT_EQ(run_espalier(run_arguments(sheet(a), out)).exit_code, 0);
  const std::string picture = read_text_file(runs / "row1-column1" / "picture.png");
  const auto written = fs::last_write_time(runs / "row1-column1" / "picture.png");
  ASSERT_EQ(run_espalier(run_arguments(sheet(b + ", " + a), out)).exit_code, 0);
  EXPECT_EQ(read_text_file(runs / "row1-column2" / "picture.png"), picture);
  EXPECT_EQ(fs::last_write_time(runs / "row1-column2" / "picture.png"), written) << "drawn again";
  EXPECT_NE(read_text_file(runs / "row1-column1" / "picture.png"), picture);
}

TEST(ExperimentCommand, LSystemsAndSeveralViewsAreFittedAndReported) {
  const fs::path study =
      file_with("study.toml",
                "[fits]\ntargets = [{species = 'small_pine', seed = 2, views = ['90,0']}, 'oc_evergreen']\n"
                "spaces = ['default', {label = 'own', model = 'own.lsys'}]\nevaluations = 40\nsize = 32\n"
                "unseen_seeds = 2\nsiblings = 2\n");
  fs::copy_file(ESPALIER_SOURCE_DIR "/src/lsystem/models/small_pine.lsys", study.parent_path() / "own.lsys");
  const fs::path out = fresh_folder("lsystem_study") / "out";
  const ProgramRun run = run_espalier(run_arguments(study, out));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const CsvTable results = read_csv(out / "results.csv");
  ASSERT_EQ(results.rows.size(), 4u);
  for (std::size_t row = 0; row < 4; ++row)
    EXPECT_EQ(results.text(row, "status"), "done") << results.text(row, "error");
  EXPECT_EQ(results.text(0, "truth_iou"), results.text(1, "truth_iou")) << "the tree's, whatever is fitted";
  EXPECT_EQ(results.text(0, "sibling_side_iou"), results.text(1, "sibling_side_iou"));
  EXPECT_TRUE(fs::exists(out / "targets" / "small_pine+2.png"));
  const fs::path own = out / "runs" / results.text(1, "run");
  const std::string record = read_text_file(own / "run.toml");
  EXPECT_THAT(record, HasSubstr("small_pine+2.png"));
  EXPECT_THAT(record, HasSubstr("model = \"model/own.lsys\""));
  EXPECT_EQ(read_text_file(own / "model/own.lsys"), read_text_file(study.parent_path() / "own.lsys"));
  const ProgramRun report = run_espalier("experiment report '" + out.string() + "'");
  EXPECT_EQ(report.exit_code, 0) << report.err;
}

/// The experiments of docs/experiments.md, with few evaluations.
TEST(ExperimentCommand, SearchesOfTheSpeciesSpaceKindsAndTwoObjectivesAreReported) {
  const std::string small = "evaluations = 60\nsize = 32\nmax_stems = 300\nmax_leaves = 1000\n";
  const std::string studies[] = {
      "targets = ['oc_palm']\nspaces = ['default', {label = 'species first', first = 'species:2'}]\n",
      "targets = ['tr_birch', 'oc_palm']\nkind = 'auto'\noptimizers = ['LN_SBPLX', 'hewitt_ga']\n"
      "objectives = ['iou', 'truncated_distance']\nseeds = 2\n",
  };
  for (const std::string& study : studies) {
    const fs::path out = fresh_folder("shown") / "out";
    ASSERT_EQ(run_espalier(run_arguments(file_with("shown.toml", "[fits]\n" + study + small), out)).exit_code,
              0);
    const ProgramRun report = run_espalier("experiment report '" + out.string() + "'");
    EXPECT_EQ(report.exit_code, 0) << study << report.err;
    EXPECT_TRUE(fs::exists(out / "report" / "index.html"));
  }
}

TEST(ExperimentCommand, AFailedRunIsARowAndTheOthersGoOn) {
  const fs::path study = file_with("study.toml",
                                   "[fits]\ntargets = ['oc_palm']\noptimizers = ['GN_AGS', 'random_search']\n"
                                   "evaluations = 20\nsize = 32\n");
  const fs::path out = fresh_folder("failed") / "out";
  const ProgramRun run = run_espalier("experiment run '" + study.string() + "' --out '" + out.string() + "'");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("expected at most 10"));
  const CsvTable results = read_csv(out / "results.csv");
  ASSERT_EQ(results.rows.size(), 2u);
  EXPECT_EQ(results.text(0, "status"), "failed");
  EXPECT_THAT(results.text(0, "error"), HasSubstr("free parameters"));
  EXPECT_EQ(results.text(1, "status"), "done");
}

TEST(ExperimentCommand, FailsWhereAllRunsFailed) {
  const fs::path study = file_with("study.toml",
                                   "[fits]\ntargets = ['oc_palm']\noptimizers = ['GN_AGS']\n"
                                   "evaluations = 20\nsize = 32\nseeds = 2\n");
  const fs::path out = fresh_folder("all_failed") / "out";
  const ProgramRun run =
      run_espalier("experiment run '" + study.string() + "' --quiet --out '" + out.string() + "'");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("all 2 runs failed"));
  EXPECT_THAT(run.err, HasSubstr("free parameters"));
}

TEST(ExperimentCommand, RefusesBadValuesBeforeTheFirstRun) {
  const fs::path study =
      file_with("study.toml", "[fits]\ntargets = ['oc_palm']\nevaluations = 20\nkind = 'leavy'\n");
  const fs::path out = fresh_folder("refused") / "out";
  expect_error("experiment run '" + study.string() + "' --out '" + out.string() + "'",
               "study.toml:4: kind: got 'leavy', expected auto, any, leafy, leafless, palm");
  EXPECT_FALSE(fs::exists(out));
}

TEST(ExperimentCommand, TheTrueParametersAreScoredOnTheSameUnseenSeeds) {
  const CsvTable results = read_csv(finished_study() / "results.csv");
  ASSERT_EQ(results.rows.size(), 8u);
  for (std::size_t row = 0; row < results.rows.size(); ++row) {
    EXPECT_FALSE(results.text(row, "unseen_fitness").empty());
    const bool is_known = results.text(row, "target") == "palm";
    EXPECT_EQ(results.text(row, "truth_fitness").empty(), !is_known);
    EXPECT_EQ(results.text(row, "side_iou").empty(), !is_known);
    EXPECT_EQ(results.text(row, "sibling_side_iou").empty(), !is_known);
    EXPECT_FALSE(results.text(row, "depth_over_width").empty());
  }
}

TEST(ExperimentCommand, TheQuickExperimentRunsAndIsReported) {
  const fs::path out = fresh_folder("quick") / "quick";
  ASSERT_EQ(run_espalier(run_arguments(kQuick, out)).exit_code, 0);
  const ProgramRun report = run_espalier("experiment report '" + out.string() + "'");
  ASSERT_EQ(report.exit_code, 0) << report.err;
  for (const char* file : {"index.html", "convergence.csv", "data_profile.csv", "ranks_fitness.csv",
                           "friedman_fitness.csv", "results.csv", "generations.csv"})
    EXPECT_GT(fs::file_size(out / "report" / file), 50u) << file;
  const bool can_plot = run_shell("/usr/bin/python3 -c 'import matplotlib'").exit_code == 0;
  EXPECT_EQ(fs::exists(out / "report" / "convergence.svg"), can_plot);
  EXPECT_EQ(run_espalier("experiment check '" + out.string() + "'").exit_code, 0);
}

TEST(ExperimentCommand, ASheetOfPicturesAndGrowthAreReported) {
  const fs::path folder = fresh_folder("kinds");
  const fs::path sheet =
      file_with("sheet.toml",
                "[pictures]\nspecies = 'palm'\nsize = 32\nrows = [{label = 'a'}, {label = 'b', set = "
                "{leaf_blos_num = 0}}]\ncolumns = [{label = 'c', set = {flare = 2}}]\n");
  const fs::path growth = file_with("growth.toml", "[growth]\nspecies = ['palm', 'acer']\nseeds = 3\n");
  for (const fs::path& file : {sheet, growth}) {
    const fs::path out = folder / file.stem();
    ASSERT_EQ(run_espalier(run_arguments(file, out)).exit_code, 0);
    ASSERT_EQ(run_espalier("experiment report '" + out.string() + "'").exit_code, 0);
    EXPECT_TRUE(fs::exists(out / "report" / "index.html"));
  }
  EXPECT_TRUE(fs::exists(folder / "sheet/runs/row2-column1/picture.png"));
  EXPECT_EQ(read_csv(folder / "growth/report/growth_times.csv").rows.size(), 6u);
}

TEST(ExperimentCommand, ABrokenExpectationEndsWithOne) {
  const fs::path out = finished_study();
  const auto check = [&](const std::string& text) {
    return run_espalier("experiment check '" + out.string() + "' '" + file_with("x.toml", text).string() +
                        "'");
  };
  const ProgramRun holds = check("[[expect]]\ncolumn = 'fitness'\nat_least = 0.1\nat_most = 1.0\n");
  EXPECT_EQ(holds.exit_code, 0) << holds.err;
  const ProgramRun broken = check("[[expect]]\ncolumn = 'fitness'\nstatistic = 'min'\nat_least = 1.01\n");
  EXPECT_EQ(broken.exit_code, 1);
  EXPECT_THAT(broken.out, HasSubstr("BROKEN"));
  expect_one_clear_error(check("[[expect]]\ncolumn = 'fitnes'\nat_least = 0\n"));
  expect_one_clear_error(check("[[expect]]\ncolumn = 'fitness'\n"));
  expect_one_clear_error(check("[[expect]]\ncolumn = 'fitness'\nvalue = 1\n"));
  expect_one_clear_error(check("[[expect]]\ncolumn = 'fitness'\nat_least = 0\nwhere = {target = 'oak'}\n"));
  expect_one_clear_error(check("[[expect]]\ntable = 'no.csv'\ncolumn = 'fitness'\nat_least = 0\n"));
}

TEST(ExperimentCommand, RefusesDirectoriesOfOthers) {
  const fs::path folder = fresh_folder("others"), study = small_study();
  const fs::path other = file_with("other.toml", "[growth]\nspecies = ['palm']\nseeds = 1\n");
  ASSERT_EQ(run_espalier(run_arguments(other, folder / "growth")).exit_code, 0);
  expect_error(run_arguments(study, folder / "growth"), "another experiment, of [fits]");
  fs::create_directory(folder / "full");
  std::ofstream(folder / "full" / "letter.txt") << "x";
  expect_error(run_arguments(study, folder / "full"), "other files");
  EXPECT_FALSE(fs::exists(folder / "full" / "lock")) << "nothing is left there";
  std::ofstream(folder / "file") << "x";
  expect_error(run_arguments(study, folder / "file"), "got a file");
  expect_error("experiment report '" + (folder / "full").string() + "'", "experiment.toml");
  expect_error("experiment run '" + (folder / "none.toml").string() + "'", "none.toml");
}

TEST(ExperimentCommand, RefusesADirectoryThatAnotherProcessWorksIn) {
  const fs::path out = finished_study();
  const int file = open((out / "lock").c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0644);
  ASSERT_EQ(flock(file, LOCK_EX), 0);
  expect_error(run_arguments(small_study(), out), "another process");
  close(file);
  EXPECT_EQ(run_espalier(run_arguments(small_study(), out)).exit_code, 0);
}

}  // namespace
}  // namespace espalier
