// The archive that a run leaves: presets that fit nearly as well as the best.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <espalier/fitting/run/fit.h>
#include <espalier/models/preset.h>

#include "support/temporary_folders.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

FitRecord small_record() {
  FitRecord record;
  record.views = {{fs::path(ESPALIER_SOURCE_DIR) / "targets/tr_birch.png", {}}};
  record.target.size_px = 32;
  record.budget = {.evaluations = 400, .seconds = 0};
  record.growth = {150, 600};
  record.start = "quaking_aspen";
  record.search.free = {"g_scale", "flare", "length[1]", "down_angle_v[2]", "base_size[0]"};
  return record;
}

fs::path run_of(const std::string& name, const FitRecord& record, FitExecution options = {}) {
  const fs::path run = options.resume ? fs::path(name) : fresh_folder(name) / "run";
  fit(record, run, options);
  return run;
}

std::string everything(const fs::path& run) {
  std::string text;
  for (int i = 1; i <= 9; ++i) text += read_text_file(run / "archive" / (std::to_string(i) + ".toml"));
  return text;
}

TEST(Archive, IsLeftAsPresetsThatFitNearlyAsWell) {
  const fs::path run = run_of("archive_files", small_record());
  const auto summary = nlohmann::json::parse(read_text_file(run / "summary.json"));
  ASSERT_GT(summary["archive"].size(), 1u);
  EXPECT_EQ(summary["archive"][0]["distance"], 0);
  const double best = summary["fitness"], tolerance = std::max(0.05 * (1 - best), 0.002);
  for (const auto& row : summary["archive"]) {
    const Preset preset = load_preset((run / row["preset"].get<std::string>()).string());
    EXPECT_GE(row["fitness"].get<double>() + 1e-12, best - tolerance);
    EXPECT_EQ(preset.model, "weber_penn");
  }
}

TEST(Archive, AnArchivedTreeOfATrainedRunGrowsIntoTheSameOutline) {
  FitRecord record = small_record();
  record.train_to_target = true;
  const fs::path run = run_of("archive_trained", record);
  const Preset archived = load_preset((run / "archive/1.toml").string());
  ASSERT_EQ(archived.grown_into.size(), 1u);
  EXPECT_NE(envelope_of(archived.grown_into), nullptr);
  EXPECT_EQ(read_text_file(run / "archive/outline.png"), read_text_file(run / "outline.png"));
}

TEST(Archive, NeitherThreadsNorABreakChangeIt) {
  const std::string unbroken = everything(run_of("archive_one", small_record(), {.threads = 1}));
  EXPECT_EQ(everything(run_of("archive_two", small_record(), {.threads = 2})), unbroken);
  FitRecord shorter = small_record();
  shorter.budget.evaluations = 130;
  const fs::path broken = run_of("archive_broken", shorter);
  run_of(broken, small_record(), {.resume = true});
  EXPECT_EQ(everything(broken), unbroken);
}

TEST(Archive, AnArchiveThatShrinksLeavesNoFileBehind) {
  const fs::path run = run_of("archive_stale", small_record());
  std::ofstream(run / "archive" / "9.toml") << "stale";
  for (int i = 1; i < 9; ++i) {
    const fs::path file = run / "archive" / (std::to_string(i) + ".toml");
    if (!fs::exists(file)) std::ofstream(file) << "stale";
  }
  run_of(run, small_record(), {.resume = true});
  const auto summary = nlohmann::json::parse(read_text_file(run / "summary.json"));
  const auto files = std::distance(fs::directory_iterator(run / "archive"), fs::directory_iterator());
  EXPECT_EQ(static_cast<std::size_t>(files), summary["archive"].size());
}

}  // namespace
}  // namespace espalier
