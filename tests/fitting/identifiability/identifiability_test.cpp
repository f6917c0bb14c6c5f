// How sure a fit is, on scores whose shape is known, and in the files of a run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include <espalier/core/error.h>
#include <espalier/fitting/identifiability/identifiability.h>
#include <espalier/fitting/identifiability/identifiability_files.h>
#include <espalier/fitting/run/fit.h>
#include <espalier/models/preset.h>

#include "support/temporary_folders.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

/// Steep along the first coordinate, gentle along the second; the third one moves nothing.
struct Valley : Scorer {
  long scored = 0;
  void score(std::span<const ParameterValues> candidates, std::span<double> scores) override {
    for (std::size_t i = 0; i < candidates.size(); ++i, ++scored) {
      const ParameterValues& x = candidates[i];
      scores[i] = 0.1 + 20 * (x[0] - 0.5) * (x[0] - 0.5) + 0.01 * (x[1] - 0.5) * (x[1] - 0.5);
    }
  }
};

SolutionArchive archive_at_the_bottom() {
  SearchSpace space{{0, 0, 0}, {}};
  for (const char* name : {"steep", "gentle", "idle"}) space.free.push_back({space.free.size(), name});
  SolutionArchive archive(space);
  archive.offer({0.5, 0.5, 0.5}, 0.1);
  return archive;
}

TEST(Identifiability, TellsWhatTheScoreDeterminesFromWhatItDoesNot) {
  Valley valley;
  SolutionArchive archive = archive_at_the_bottom();
  const IdentifiabilityReport report = measure_identifiability(archive, valley, 300, 1);
  ASSERT_EQ(report.parameters.size(), 3u);
  EXPECT_EQ(report.parameters[0].identifiability, Identifiability::determined);
  EXPECT_EQ(report.parameters[1].identifiability, Identifiability::open);
  EXPECT_EQ(report.parameters[2].identifiability, Identifiability::no_effect);
  EXPECT_NEAR(*report.parameters[0].rise_above, 20 * 0.01, 1e-12);
  EXPECT_NEAR(*report.parameters[1].rise_below, 0.01 * 0.01, 1e-12);
  EXPECT_LT(report.parameters[0].spread, 0.1);
  EXPECT_GT(report.parameters[1].spread, 0.5);
  EXPECT_EQ(archive.solutions().front().score, 0.1);
}

TEST(Identifiability, KeepsToItsEvaluations) {
  for (const long allowed : {0, 5, 6, 7, 50, 100'000}) {
    Valley valley;
    SolutionArchive archive = archive_at_the_bottom();
    const IdentifiabilityReport report = measure_identifiability(archive, valley, allowed, 1);
    EXPECT_LE(valley.scored, allowed);
    EXPECT_LE(valley.scored, 250);
    EXPECT_EQ(report.evaluations, valley.scored);
    EXPECT_EQ(report.parameters.empty(), allowed < 6);
  }
}

TEST(Identifiability, WhereTheRangeEndsThereIsNoStep) {
  Valley valley;
  SolutionArchive archive(archive_at_the_bottom().space());
  archive.offer({0.5, 0, 1}, 0.1025);
  const IdentifiabilityReport report = measure_identifiability(archive, valley, 6, 1);
  EXPECT_FALSE(report.parameters[1].rise_below.has_value());
  EXPECT_TRUE(report.parameters[1].rise_above.has_value());
  EXPECT_FALSE(report.parameters[2].rise_above.has_value());
}

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
  std::string text = read_text_file(run / "parameters.csv");
  for (int i = 1; i <= 9; ++i) text += read_text_file(run / "archive" / (std::to_string(i) + ".toml"));
  return text;
}

TEST(Identifiability, ARunLeavesItsArchiveAsPresetsAndItsParametersAsATable) {
  const fs::path run = run_of("identifiability_files", small_record());
  const auto summary = nlohmann::json::parse(read_text_file(run / "summary.json"));
  ASSERT_GT(summary["archive"].size(), 1u);
  EXPECT_EQ(summary["archive"][0]["distance"], 0);
  for (const auto& row : summary["archive"]) {
    const Preset preset = load_preset((run / row["preset"].get<std::string>()).string());
    EXPECT_GE(row["fitness"].get<double>() + 1e-12,
              summary["fitness"].get<double>() - summary["parameters"]["tolerance"].get<double>());
    EXPECT_EQ(preset.model, "weber_penn");
  }
  const std::string csv = read_text_file(run / "parameters.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 5);
  EXPECT_THAT(csv, testing::HasSubstr("\nbase_size[0],"));
  EXPECT_THAT(read_text_file(run / "parameters.svg"), testing::HasSubstr(">base_size[0]</text>"));
}

TEST(Identifiability, AnArchivedTreeOfATrainedRunGrowsIntoTheSameOutline) {
  FitRecord record = small_record();
  record.train_to_target = true;
  const fs::path run = run_of("identifiability_trained", record);
  const Preset archived = load_preset((run / "archive/1.toml").string());
  ASSERT_EQ(archived.grown_into.size(), 1u);
  EXPECT_NE(envelope_of(archived.grown_into), nullptr);
  EXPECT_EQ(read_text_file(run / "archive/outline.png"), read_text_file(run / "outline.png"));
}

TEST(Identifiability, NeitherThreadsNorABreakChangeIt) {
  const std::string unbroken = everything(run_of("identifiability_one", small_record(), {.threads = 1}));
  EXPECT_EQ(everything(run_of("identifiability_two", small_record(), {.threads = 2})), unbroken);
  FitRecord shorter = small_record();
  shorter.budget.evaluations = 130;
  const fs::path broken = run_of("identifiability_broken", shorter);
  run_of(broken, small_record(), {.resume = true});
  EXPECT_EQ(everything(broken), unbroken);
}

TEST(Identifiability, AnArchiveThatShrinksLeavesNoFileBehind) {
  const fs::path run = run_of("identifiability_stale", small_record());
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

TEST(Identifiability, IsNoPartOfATooShortRun) {
  FitRecord record = small_record();
  record.budget.evaluations = 60;
  const fs::path run = run_of("identifiability_short", record);
  EXPECT_FALSE(fs::exists(run / "parameters.csv"));
  EXPECT_TRUE(fs::exists(run / "archive" / "1.toml"));
}

}  // namespace
}  // namespace espalier
