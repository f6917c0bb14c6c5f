// Fits as wholes, small ones: the same record gives the same bits, however often it is broken off, stopped
// or repeated and with any number of threads; the directory holds what it says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include <espalier/core/error.h>
#include <espalier/fitting/run/fit.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>

#include "support/small_fits.h"
#include "support/temporary_folders.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A palm at 32×32 pixels, `evaluations` of them, two of which are start points.
FitRecord small_record(long evaluations) { return small_palm_fit(evaluations); }

fs::path new_run(const std::string& name) { return fresh_folder(name) / "run"; }

/// The trace without its column of seconds.
std::string trace_without_seconds(const fs::path& run) {
  std::istringstream csv(read_text_file(run / "trace.csv"));
  std::string text;
  for (std::string line; std::getline(csv, line);) {
    const auto first = line.find(','), second = line.find(',', first + 1);
    text += line.substr(0, first) + line.substr(second) + "\n";
  }
  return text;
}

void expect_same_run(const fs::path& a, const fs::path& b) {
  EXPECT_EQ(read_text_file(a / "best.toml"), read_text_file(b / "best.toml"));
  EXPECT_EQ(read_text_file(a / "best.png"), read_text_file(b / "best.png"));
  EXPECT_EQ(trace_without_seconds(a), trace_without_seconds(b));
}

/// Options that ask to stop after `batches` batches.
FitExecution stopping_after(int batches) {
  FitExecution options;
  options.stop_requested = [left = batches]() mutable { return left-- <= 0; };
  return options;
}

std::string error_of_fit(const FitRecord& record, const fs::path& directory,
                         const FitExecution& options = {}) {
  try {
    fit(record, directory, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Fit, LeavesEveryFileOfARun) {
  const fs::path run = new_run("files");
  fit(small_record(40), run);
  for (const char* name :
       {"run.toml", "trace.csv", "best.toml", "target.png", "best.png", "overlay.png", "convergence.svg",
        "convergence.png", "summary.json", "evaluations.bin", "archive", "tree.png", "picture.png", "lock"})
    EXPECT_TRUE(fs::exists(run / name)) << name;
  EXPECT_EQ(std::distance(fs::directory_iterator(run), {}), 14) << "no temporary file is left";
}

TEST(Fit, SummarySaysWhatWasDone) {
  const fs::path run = new_run("summary");
  FitRecord record = small_record(40);
  record.height_m = 7;
  const FitResult result = fit(record, run);
  const auto summary = nlohmann::json::parse(read_text_file(run / "summary.json"));
  EXPECT_EQ(summary["evaluations"], 40);
  EXPECT_EQ(summary["stopped_by"], "evaluations");
  EXPECT_EQ(summary["iou"], result.metrics["iou"]);
  EXPECT_LE(summary["embree_disagreement_pixels"], 2);
  EXPECT_EQ(summary["optimizer"], "cma_es");
  EXPECT_EQ(summary["seed"], 1);
  EXPECT_EQ(summary["height_m"], 7);
  for (const char* key :
       {"tolerant_iou", "outline_iou", "pixel_accuracy", "seconds", "evaluations_per_second"})
    EXPECT_TRUE(summary[key].is_number()) << key;
}

TEST(Fit, BestIsAPresetThatGrowsTheBestMask) {
  const fs::path run = new_run("best");
  const FitResult result = fit(small_record(60), run);
  const Preset best = load_preset((run / "best.toml").string());
  EXPECT_EQ(best.values, result.values);
  const TargetPicture drawn = read_mask(run / "best.png"), target = read_mask(run / "target.png");
  EXPECT_DOUBLE_EQ(iou(drawn.mask, target.mask), result.metrics["iou"]);
}

TEST(Fit, IsNeverWorseThanItsBestStart) {
  const fs::path run = new_run("starts");
  const FitResult result = fit(small_record(40), run);
  const auto summary = nlohmann::json::parse(read_text_file(run / "summary.json"));
  for (const auto& start : summary["starts"]) EXPECT_GE(result.fitness, start["fitness"]);
}

TEST(Fit, GivesTheSameBitsForAnyNumberOfThreads) {
  const fs::path one = new_run("one"), two = new_run("two");
  FitExecution options;
  options.threads = 1;
  fit(small_record(80), one, options);
  options.threads = 2;
  fit(small_record(80), two, options);
  expect_same_run(one, two);
}

TEST(Fit, ResumesFromAnyCutOfTheLogToTheUnbrokenRun) {
  const fs::path unbroken = new_run("unbroken");
  const FitRecord record = small_record(80);
  fit(record, unbroken);
  for (const std::uintmax_t bytes : {0u, 5u, 8u, 31u, 8u + 24 * 2, 8u + 24 * 33 + 7, 8u + 24 * 80}) {
    const fs::path broken = fresh_folder("broken");
    fs::copy(unbroken, broken);
    fs::resize_file(broken / "evaluations.bin", bytes);
    for (const char* name : {"best.toml", "trace.csv", "summary.json", "best.png"}) fs::remove(broken / name);
    FitExecution options;
    options.resume = true;
    fit(read_record(broken / "run.toml").record, broken, options);
    expect_same_run(broken, unbroken);
    EXPECT_EQ(fs::file_size(broken / "evaluations.bin"), 8u + 24 * 80);
  }
}

TEST(Fit, ARunThatWasStoppedRepeatsByItsCountWithEveryOptimizer) {
  for (const auto& optimizer : all_optimizers()) {
    FitRecord record = small_record(0);
    record.optimizer = optimizer->name();
    record.budget.seconds = 1000;
    if (optimizer->max_dimension() < 20) record.search.free = {"g_scale", "ratio"};
    const fs::path stopped = new_run("stopped"), repeated = new_run("repeated");
    const FitResult first = fit(record, stopped, stopping_after(4));
    EXPECT_EQ(first.stopped_by, FitStop::interrupted) << record.optimizer;
    const RecordedRun recorded = read_record(stopped / "run.toml");
    ASSERT_TRUE(recorded.outcome);
    record.budget = {recorded.outcome->evaluations, 0, 0};
    fit(record, repeated);
    SCOPED_TRACE(record.optimizer);
    expect_same_run(stopped, repeated);
  }
}

/// A palm that searches two coordinates for 30 evaluations, after its two starts.
FitRecord space_record(long evaluations) {
  FitRecord record = small_record(evaluations);
  record.space = "species:2";
  record.space_evaluations = 30;
  return record;
}

TEST(Fit, SearchesTheSpeciesSpaceBetweenStartsAndParameters) {
  const fs::path run = new_run("space");
  const FitResult result = fit(space_record(80), run);
  EXPECT_EQ(result.evaluations, 80);
  const std::string trace = read_text_file(run / "trace.csv");
  EXPECT_THAT(trace, HasSubstr(",stage\n"));
  const auto first = trace.find(",starts\n"), then = trace.find(",species_space\n"),
             last = trace.find(",search\n");
  ASSERT_NE(last, trace.npos);
  EXPECT_LT(first, then);
  EXPECT_LT(then, last);
  const auto summary = nlohmann::json::parse(read_text_file(run / "summary.json"));
  EXPECT_EQ(summary["starts"].back()["name"], "species space");
  EXPECT_GE(summary["starts"].back()["fitness"], summary["starts"][0]["fitness"]) << "it begins there";
}

TEST(Fit, OfASpeciesSpaceResumesFromAnyStageToTheUnbrokenRun) {
  const fs::path unbroken = new_run("space_unbroken");
  fit(space_record(80), unbroken);
  EXPECT_EQ(read_record(unbroken / "run.toml").record.space, "species:2");
  for (const std::uintmax_t evaluations : {1u, 2u, 17u, 31u, 32u, 33u, 60u}) {
    const fs::path broken = fresh_folder("space_broken");
    fs::copy(unbroken, broken);
    fs::resize_file(broken / "evaluations.bin", 8 + 16 * evaluations);
    FitExecution options;
    options.resume = true;
    options.threads = 1;
    fit(read_record(broken / "run.toml").record, broken, options);
    SCOPED_TRACE(evaluations);
    expect_same_run(broken, unbroken);
  }
}

TEST(Fit, RefusesASpeciesSpaceThatIsNone) {
  FitRecord record = small_record(10);
  for (const char* space : {"species", "species:", "species:0", "species:2x", "plane:2"}) {
    record.space = space;
    EXPECT_THAT(error_of_fit(record, new_run("no_space")), HasSubstr("space: got")) << space;
  }
  record.space = "species:99";
  EXPECT_THAT(error_of_fit(record, new_run("no_space")), HasSubstr("expected 1 … 18"));
}

TEST(Fit, StopsAtTheTargetFitness) {
  FitRecord record = small_record(500);
  record.budget.target_fitness = 0.05;
  const FitResult result = fit(record, new_run("reached"));
  EXPECT_EQ(result.stopped_by, FitStop::target_fitness);
  EXPECT_LT(result.evaluations, 500);
}

TEST(Fit, StopsByTimeWithAResult) {
  FitRecord record = small_record(0);
  record.budget.seconds = 1e-6;
  const FitResult result = fit(record, new_run("time"));
  EXPECT_EQ(result.stopped_by, FitStop::time);
  EXPECT_GE(result.evaluations, 1);
}

TEST(Fit, FewerEvaluationsThanStartPointsStillGiveAResult) {
  EXPECT_EQ(fit(small_record(1), new_run("single")).evaluations, 1);
}

TEST(Fit, FitsSeveralViewsAndSeedsAtOnce) {
  FitRecord record = small_record(40);
  record.views.push_back({record.views[0].picture, {.azimuth_deg = 90}});
  record.fit_seeds = 2;
  const fs::path run = new_run("views");
  fit(record, run);
  for (const char* name : {"target_2.png", "best_2.png", "overlay_2.png"})
    EXPECT_TRUE(fs::exists(run / name));
}

TEST(Fit, KeepsFixedValues) {
  FitRecord record = small_record(40);
  record.search.fixed = {{"g_scale", 9.5}};
  const FitResult result = fit(record, new_run("fixed"));
  EXPECT_EQ(result.values[model_by_name("weber_penn").table().index_of("g_scale")], 9.5);
}

TEST(Fit, RefusesADirectoryThatHoldsSomethingOrIsAFile) {
  const fs::path folder = fresh_folder("taken");
  std::ofstream(folder / "thesis.txt") << "years of work";
  EXPECT_THAT(error_of_fit(small_record(10), folder), HasSubstr("with files in it"));
  EXPECT_THAT(error_of_fit(small_record(10), folder / "thesis.txt"), HasSubstr("got a file"));
  EXPECT_THAT(error_of_fit(small_record(10), folder / "thesis.txt" / "run"), HasSubstr("thesis.txt"));
  EXPECT_EQ(read_text_file(folder / "thesis.txt"), "years of work");
}

TEST(Fit, LeavesNoDirectoryBehindBadInput) {
  const fs::path run = new_run("nothing");
  FitRecord record = small_record(10);
  record.search.free = {"nope"};
  EXPECT_THAT(error_of_fit(record, run), HasSubstr("nope"));
  record = small_record(10);
  record.start = "nope";
  EXPECT_THAT(error_of_fit(record, run), HasSubstr("nope"));
  record = small_record(10);
  record.optimizer = "GN_AGS";
  EXPECT_THAT(error_of_fit(record, run), HasSubstr("GN_AGS"));
  EXPECT_FALSE(fs::exists(run));
}

TEST(Fit, RefusesToResumeWhatIsNoRunOrHasAnotherTarget) {
  FitExecution options;
  options.resume = true;
  EXPECT_THAT(error_of_fit(small_record(10), fresh_folder("no_run"), options), HasSubstr("run.toml"));
  const fs::path run = new_run("changed");
  fit(small_record(10), run);
  FitRecord record = read_record(run / "run.toml").record;
  record.views[0].copy = fs::path(ESPALIER_SOURCE_DIR) / "targets/fir.png";
  EXPECT_THAT(error_of_fit(record, run, options), HasSubstr("expected the picture of the run"));
  record.views[0].content.reset();
  EXPECT_THAT(error_of_fit(record, run, options),
              HasSubstr("got another picture than the run was begun with"));
}

}  // namespace
}  // namespace espalier
