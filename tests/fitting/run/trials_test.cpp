// The trials of a run: the points that were evaluated, bit for bit, from runs that ended, broke off or still
// write.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include <espalier/core/error.h>
#include <espalier/fitting/run/fit.h>
#include <espalier/fitting/run/trials.h>
#include <espalier/fitting/search/evaluation_log.h>
#include <espalier/fitting/task/plant_scorer.h>
#include <espalier/fitting/task/record_task.h>
#include <espalier/models/models.h>

#include "support/small_fits.h"
#include "support/temporary_folders.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A palm at 32×32 pixels, first in the species space, then by its parameters.
FitRecord record_with_trials(long evaluations) {
  FitRecord record = small_palm_fit(evaluations);
  record.space = "species:2";
  record.space_evaluations = 30;
  return record;
}

/// A trial that owns its values.
struct KeptTrial {
  FitStage stage;
  double value;
  float seconds;
  ParameterValues values;
};

std::vector<KeptTrial> trials_of(const fs::path& run) {
  std::vector<KeptTrial> kept;
  replay_trials(
      run, [](const ParameterTable&) {},
      [&](const Trial& trial) {
        EXPECT_EQ(trial.evaluation, static_cast<long>(kept.size()) + 1);
        kept.push_back({trial.stage, trial.value, trial.seconds, trial.values});
      });
  return kept;
}

std::string error_of_trials(const fs::path& run) {
  try {
    trials_of(run);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::vector<std::string> cells_of_line(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

/// The log of a search that asked for another candidate there.
void change_hash(const fs::path& log, std::size_t evaluation) {
  std::vector<LoggedEvaluation> logged = read_evaluation_log(log).evaluations;
  logged.at(evaluation - 1).candidate_hash ^= 1;
  fs::remove(log);
  EvaluationLog(log).append(logged);
}

TEST(Trials, ArePointsThatScoreWhatWasLogged) {
  const fs::path run = fresh_folder("trials") / "run";
  const FitRecord record = record_with_trials(80);
  const FitResult result = fit(record, run);
  const std::vector<KeptTrial> trials = trials_of(run);
  ASSERT_EQ(trials.size(), static_cast<std::size_t>(result.evaluations));
  const std::vector<LoggedEvaluation> logged = read_evaluation_log(run / "evaluations.bin").evaluations;
  std::vector<ParameterValues> points;
  for (const KeptTrial& trial : trials) points.push_back(trial.values);
  FitRecord again = record;
  const FitTask task = make_task(again, nullptr);
  PlantScorer scorer(task, 1);
  std::vector<double> scores(points.size());
  scorer.score(points, scores);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(scores[i]), std::bit_cast<std::uint64_t>(trials[i].value)) << i;
    EXPECT_EQ(trials[i].value, logged[i].value);
    EXPECT_EQ(trials[i].seconds, logged[i].seconds);
    EXPECT_EQ(hash_values(task.model->table(), points[i]), logged[i].candidate_hash);
  }
  const auto best = std::min_element(trials.begin(), trials.end(),
                                     [](const auto& a, const auto& b) { return a.value < b.value; });
  EXPECT_EQ(best->values, result.values);
}

TEST(Trials, SayInWhichStageTheyWereMade) {
  const fs::path run = fresh_folder("trials_stages") / "run";
  fit(record_with_trials(80), run);
  const fs::path csv = run / "trials.csv";
  const TrialCounts counts = write_trials(run, csv);
  ASSERT_EQ(counts.size(), 3u);
  EXPECT_EQ(counts[0].first, FitStage::starts);
  EXPECT_EQ(counts[1].first, FitStage::species_space);
  EXPECT_EQ(counts[2].first, FitStage::search);
  EXPECT_EQ(counts[0].second + counts[1].second + counts[2].second, 80);
}

TEST(Trials, AsATableKeepEveryBit) {
  const fs::path run = fresh_folder("trials_table") / "run";
  fit(record_with_trials(60), run);
  const std::vector<KeptTrial> trials = trials_of(run);
  write_trials(run, run / "trials.csv");
  std::istringstream csv(read_text_file(run / "trials.csv"));
  std::string line;
  std::getline(csv, line);
  const std::vector<std::string> names = cells_of_line(line);
  const ParameterTable& table = model_by_name("weber_penn").table();
  ASSERT_EQ(names.size(), 4 + table.rows.size());
  EXPECT_THAT(line, testing::StartsWith("evaluation,stage,value,seconds,"));
  for (std::size_t i = 0; i < table.rows.size(); ++i) EXPECT_EQ(names[4 + i], table.rows[i].full_name());
  std::size_t row = 0;
  for (; std::getline(csv, line); ++row) {
    const std::vector<std::string> cells = cells_of_line(line);
    ASSERT_EQ(cells.size(), names.size());
    EXPECT_EQ(std::strtod(cells[2].c_str(), nullptr), trials[row].value);
    EXPECT_EQ(std::strtof(cells[3].c_str(), nullptr), trials[row].seconds);
    for (std::size_t i = 0; i < table.rows.size(); ++i)
      EXPECT_EQ(std::strtod(cells[4 + i].c_str(), nullptr), trials[row].values[i])
          << row << " " << names[4 + i];
  }
  EXPECT_EQ(row, trials.size());
}

TEST(Trials, LeaveTheRunAsItIs) {
  const fs::path run = fresh_folder("trials_torn") / "run";
  fit(record_with_trials(60), run);
  std::ofstream(run / "evaluations.bin", std::ios::app | std::ios::binary)
      << "torn";  // by a run that still writes
  const std::string before = read_text_file(run / "evaluations.bin");
  const auto written = fs::last_write_time(run / "summary.json");
  EXPECT_EQ(trials_of(run).size(), 60u);
  EXPECT_EQ(read_text_file(run / "evaluations.bin"), before);
  EXPECT_EQ(fs::last_write_time(run / "summary.json"), written);
}

TEST(Trials, OfARunThatWasBrokenOffAreTheFirstOfTheWholeOne) {
  const fs::path folder = fresh_folder("trials_broken");
  fit(record_with_trials(80), folder / "whole");
  FitExecution stopping;
  stopping.stop_requested = [left = 6]() mutable { return left-- <= 0; };
  fit(record_with_trials(80), folder / "broken", stopping);
  const std::vector<KeptTrial> whole = trials_of(folder / "whole"), broken = trials_of(folder / "broken");
  ASSERT_GT(broken.size(), 2u);
  ASSERT_LT(broken.size(), whole.size());
  for (std::size_t i = 0; i < broken.size(); ++i) EXPECT_EQ(broken[i].values, whole[i].values) << i;
}

TEST(Trials, AreOfTheSearchAloneWhereBranchesWereRefined) {
  const fs::path run = fresh_folder("trials_refined") / "run";
  FitRecord record = record_with_trials(50);
  record.space.clear();
  record.budget.branch_rounds = 2;
  const FitResult result = fit(record, run);
  ASSERT_GT(result.branch_steps, 0);
  EXPECT_EQ(trials_of(run).size(), static_cast<std::size_t>(result.evaluations));
}

TEST(Trials, OfAnotherSearchThanTheLoggedOneAreRefused) {
  const fs::path run = fresh_folder("trials_other") / "run";
  fit(record_with_trials(60), run);
  change_hash(run / "evaluations.bin", 50);
  EXPECT_THAT(error_of_trials(run), HasSubstr("evaluation 50 differs from the one in the log"));
  std::ofstream(run / "trials.csv") << "kept";
  EXPECT_THROW(write_trials(run, run / "trials.csv"), InputError);
  EXPECT_EQ(read_text_file(run / "trials.csv"), "kept");
}

TEST(Trials, OfADamagedLogAreRefusedUntilTheRunWentOn) {
  const fs::path run = fresh_folder("trials_damaged") / "run";
  fit(record_with_trials(30), run);
  const std::size_t sound = trials_of(run).size();
  std::fstream file(run / "evaluations.bin", std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(8 + 24 * 11) << "zero";
  file.close();
  EXPECT_THAT(error_of_trials(run), HasSubstr("evaluation 12 is damaged"));
  FitExecution again;
  again.resume = true;
  fit(read_record(run / "run.toml").record, run, again);
  EXPECT_EQ(trials_of(run).size(), sound);
}

TEST(Trials, WhatIsNoRunIsRefused) {
  const fs::path folder = fresh_folder("trials_none");
  EXPECT_THAT(error_of_trials(folder / "nowhere"), HasSubstr("got no directory"));
  EXPECT_THAT(error_of_trials(folder), HasSubstr("without run.toml"));
  const fs::path run = folder / "run";
  fit(record_with_trials(20), run);
  fs::resize_file(run / "evaluations.bin", 8);
  EXPECT_THAT(error_of_trials(run), HasSubstr("got no evaluations"));
  fs::remove(run / "evaluations.bin");
  EXPECT_THAT(error_of_trials(run), HasSubstr("expected a log of evaluations"));
  EXPECT_FALSE(fs::exists(run / "evaluations.bin")) << "reading makes none";
}

}  // namespace
}  // namespace espalier
