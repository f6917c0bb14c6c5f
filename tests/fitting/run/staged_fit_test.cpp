// Fits that end with a refinement branch by branch: repeatable, resumable, and what they leave grows again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <espalier/core/error.h>
#include <espalier/fitting/run/fit.h>
#include <espalier/fitting/run/full_size.h>
#include <espalier/models/grow_preset.h>
#include <espalier/models/models.h>
#include <espalier/render/scanlines/scanline_renderer.h>

#include "support/temporary_folders.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

FitRecord staged_record(long rounds, const std::string& picture = "tr_birch") {
  FitRecord record;
  record.views = {{fs::path(ESPALIER_SOURCE_DIR) / "targets" / (picture + ".png"), {}}};
  record.target.size_px = 32;
  record.budget = {60, 0, 0, rounds};
  record.growth = {150, 600};
  record.start = "quaking_aspen";
  record.kind = KindChoice::automatic;
  return record;
}

fs::path new_run(const std::string& name) { return fresh_folder(name) / "run"; }

nlohmann::json summary_of(const fs::path& run) {
  return nlohmann::json::parse(read_text_file(run / "summary.json"));
}

nlohmann::json history_of(const fs::path& run) {
  return nlohmann::json::parse(read_text_file(run / "branches.json"))["history"];
}

struct Regrown {
  Mask mask, target;
};

/// The mask of the preset in a run's directory, grown as any command grows it, and the target's of this size.
Regrown regrown(const fs::path& run, int size_px) {
  const Preset preset = load_preset((run / "best.toml").string());
  const Plant plant = grow_preset(preset, "best");
  FitRecord record = read_record(run / "run.toml").record;
  record.target.size_px = size_px;
  const TargetPicture target = read_target(record.views[0].picture, record.target);
  Mask mask;
  make_scanline_renderer()->draw(
      plant, make_target_view(target.mask, target.tree_height_px, {}, kNominalHeightM).camera, mask);
  return {mask, target.mask};
}

TEST(StagedFit, TheRefinementIsNotWorseThanTheSearch) {
  const FitResult searched = fit(staged_record(0), new_run("search_only"));
  const FitResult refined = fit(staged_record(2), new_run("search_and_branches"));
  EXPECT_GT(refined.fitness, searched.fitness + 0.01);
  EXPECT_EQ(refined.values, searched.values);
  EXPECT_FALSE(refined.overrides.empty());
  EXPECT_GT(refined.branch_steps, 1000);
  EXPECT_EQ(refined.stopped_by, FitStop::rounds);
}

TEST(StagedFit, ThePresetItLeavesGrowsTheSamePicture) {
  for (const bool train : {false, true}) {
    const fs::path run = new_run(train ? "regrown_trained" : "regrown");
    FitRecord record = staged_record(2);
    record.train_to_target = train;
    record.seed = 7;
    fit(record, run);
    const Mask mask = regrown(run, record.target.size_px).mask;
    EXPECT_EQ(differing_px(mask, read_mask(run / "best.png").mask), 0u) << "trained: " << train;
    const Regrown full = regrown(run, kFullSizePx);
    const MaskMetrics metrics = compare_masks(full.mask, full.target);
    const auto reported = summary_of(run)["full_size"];
    EXPECT_NEAR(reported["iou"], metrics["iou"], 1e-6) << "trained: " << train;
    EXPECT_NEAR(reported["outline_iou"], metrics["outline_iou"], 1e-6) << "trained: " << train;
  }
}

FitRecord lsystem_record(long rounds) {
  FitRecord record = staged_record(rounds, "fir");
  record.model = "small_pine.lsys";
  record.start = "defaults";
  record.growth = {};
  return record;
}

TEST(StagedFit, AnLsystemIsRefinedBranchByBranchToo) {
  const fs::path run = new_run("lsystem_branches");
  const FitResult searched = fit(lsystem_record(0), new_run("lsystem_search")),
                  refined = fit(lsystem_record(3), run);
  EXPECT_GT(refined.fitness, searched.fitness + 0.01);
  EXPECT_EQ(refined.values, searched.values);
  EXPECT_FALSE(refined.overrides.empty());
  EXPECT_EQ(differing_px(regrown(run, 32).mask, read_mask(run / "best.png").mask), 0u);
}

TEST(StagedFit, ALeaflessPictureIsNotTracedByAnLsystem) {
  FitRecord search = lsystem_record(0), record = lsystem_record(1);
  search.kind = record.kind = KindChoice::leafless;
  const FitResult searched = fit(search, new_run("lsystem_leafless_search")),
                  refined = fit(record, new_run("lsystem_leafless"));
  EXPECT_GE(refined.fitness, searched.fitness);
  EXPECT_EQ(refined.values, searched.values);
}

TEST(StagedFit, AnLsystemCannotBeTrained) {
  FitRecord record = lsystem_record(1);
  record.train_to_target = true;
  EXPECT_THROW(fit(record, new_run("lsystem_trained")), InputError);
}

TEST(StagedFit, ResumedItIsTheUnbrokenRun) {
  const fs::path unbroken = new_run("staged_unbroken"), broken = new_run("staged_broken");
  fit(staged_record(3), unbroken);
  fit(staged_record(1), broken);
  FitExecution options;
  options.resume = true;
  fit(staged_record(3), broken, options);
  EXPECT_EQ(read_text_file(broken / "best.toml"), read_text_file(unbroken / "best.toml"));
  const auto whole = nlohmann::json::parse(read_text_file(unbroken / "branches.json")),
             resumed = nlohmann::json::parse(read_text_file(broken / "branches.json"));
  EXPECT_EQ(whole["lanes"], resumed["lanes"]);
  EXPECT_EQ(whole["history"].size(), resumed["history"].size());
}

/// Five rounds, the last two of which look finer.
FitRecord finished_record(long rounds) {
  FitRecord record = staged_record(rounds);
  record.budget.finish_from = 3;
  return record;
}

TEST(StagedFit, ResumedInItsFinishItIsTheUnbrokenRun) {
  const fs::path unbroken = new_run("finish_unbroken"), broken = new_run("finish_broken");
  fit(finished_record(5), unbroken);
  fit(finished_record(4), broken);
  FitExecution options;
  options.resume = true;
  fit(finished_record(5), broken, options);
  EXPECT_EQ(read_text_file(broken / "best.toml"), read_text_file(unbroken / "best.toml"));
  EXPECT_EQ(history_of(broken).size(), history_of(unbroken).size());
}

/// What its last rounds minimise is one less the IoU of what the summary says of masks of 512 pixels.
TEST(StagedFit, APalmEndsAtFullSizeAlone) {
  FitRecord record = finished_record(4);
  record.views[0].picture = fs::path(ESPALIER_SOURCE_DIR) / "targets/oc_palm.png";
  record.start = "palm";
  record.objective = "iou";
  record.growth = {300, 3000};
  const fs::path run = new_run("palm_finish");
  fit(record, run);
  EXPECT_EQ(history_of(run).back()["stage"], "finish");
  EXPECT_LT(history_of(run).back()["own_score"], 0.9);
  EXPECT_NEAR(history_of(run).back()["own_score"].get<double>(),
              1 - summary_of(run)["full_size"]["iou"].get<double>(), 1e-9);
}

TEST(StagedFit, RepeatedFromItsOutcomeItIsTheSameRun) {
  const fs::path run = new_run("finish_first"), again = new_run("finish_again");
  fit(staged_record(5), run);
  const auto [record, outcome] = read_record(run / "run.toml");
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome->finish_from, 3);
  FitRecord repeated = record;
  repeated.budget = {outcome->evaluations, 0, 0, outcome->branch_rounds, outcome->finish_from};
  fit(repeated, again);
  EXPECT_EQ(read_text_file(again / "best.toml"), read_text_file(run / "best.toml"));
}

TEST(StagedFit, NoStageEndsWorseThanItBegan) {
  const fs::path run = new_run("stages_in_order");
  FitRecord record = staged_record(8, "tr_crookedtree4");
  record.target.size_px = 64;
  fit(record, run);
  const auto history = history_of(run);
  std::vector<std::string> stages;
  for (std::size_t i = 0; i < history.size(); ++i) {
    if (stages.empty() || stages.back() != history[i]["stage"])
      stages.push_back(history[i]["stage"]);
    else
      EXPECT_LE(history[i]["own_score"], history[i - 1]["own_score"]) << i;
  }
  EXPECT_EQ(stages, (std::vector<std::string>{"tracing", "finish"}))
      << "a traced tree is refined at full size";
}

TEST(StagedFit, AStageAloneGoesOnFromTheTreeOfAnotherRun) {
  const fs::path whole = new_run("without_finish");
  FitRecord record = staged_record(3);
  record.stages.finish = false;
  const FitResult first = fit(record, whole);
  record.stages = {.search = false, .tracing = false, .branches = true, .finish = false};
  record.start = (whole / "best.toml").string();
  const fs::path alone = new_run("branches_alone");
  const FitResult second = fit(record, alone);
  EXPECT_DOUBLE_EQ(1 - history_of(alone).front()["score"].get<double>(), first.fitness);
  EXPECT_GE(second.fitness, first.fitness);
  EXPECT_EQ(second.values, first.values);
  EXPECT_EQ(second.dimension, 0u);
}

TEST(StagedFit, TheStartsAloneChangeNothing) {
  FitRecord record = staged_record(3);
  record.stages = parse_stages("starts");
  const FitResult result = fit(record, new_run("starts_alone"));
  EXPECT_EQ(result.stopped_by, FitStop::stages);
  EXPECT_EQ(result.evaluations, 1);
  EXPECT_EQ(result.branch_steps, 0);
}

TEST(StagedFit, ResumedWithALongerSearchItRefinesWhatThatFinds) {
  const fs::path unbroken = new_run("staged_longer"), broken = new_run("staged_shorter");
  FitRecord longer = staged_record(1);
  longer.budget.evaluations = 90;
  fit(longer, unbroken);
  fit(staged_record(1), broken);
  FitExecution options;
  options.resume = true;
  fit(longer, broken, options);
  EXPECT_EQ(read_text_file(broken / "best.toml"), read_text_file(unbroken / "best.toml"));
}

TEST(StagedFit, ThreadsDoNotChangeIt) {
  const fs::path one = new_run("staged_one"), two = new_run("staged_two");
  FitExecution options;
  options.threads = 1;
  fit(staged_record(2), one, options);
  options.threads = 2;
  fit(staged_record(2), two, options);
  EXPECT_EQ(read_text_file(one / "best.toml"), read_text_file(two / "best.toml"));
}

TEST(StagedFit, ATrainedTreeSaysSoAndReportsTheTreeWithoutTraining) {
  const fs::path run = new_run("trained");
  FitRecord record = staged_record(1);
  record.train_to_target = true;
  fit(record, run);
  const auto summary = summary_of(run);
  EXPECT_EQ(summary["trained_to_target"], true);
  EXPECT_TRUE(summary["without_training"].contains("iou"));
  EXPECT_TRUE(fs::exists(run / "outline.png"));
}

TEST(StagedFit, AWinterTreeIsFittedWithoutLeaves) {
  const fs::path run = new_run("winter");
  const FitResult result = fit(staged_record(0, "tr_crookedtree4"), run);
  EXPECT_EQ(summary_of(run)["kind"], "leafless");
  EXPECT_EQ(result.values[model_by_name("weber_penn").table().index_of("leaf_blos_num")], 0);
}

TEST(StagedFit, WhatTheUserFreesIsLeftToHim) {
  FitRecord record = staged_record(0, "tr_crookedtree4");
  record.search.free = {"leaf_blos_num", "g_scale"};
  EXPECT_NO_THROW(fit(record, new_run("winter_freed")));
}

TEST(StagedFit, SeveralSeedsAreNotRefined) {
  FitRecord record = staged_record(2);
  record.fit_seeds = 2;
  EXPECT_EQ(fit(record, new_run("two_seeds")).branch_steps, 0);
}

}  // namespace
}  // namespace espalier
