// Moves of runs to new names, stopped after each of their steps and gone on with.
#include <gtest/gtest.h>

#include <fstream>
#include <map>

#include <espalier/experiments/runner/move_runs.h>

#include "support/temporary_folders.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

struct Killed {};

/// A directory of runs, each with a file that says what it was called.
fs::path directory_of_runs(const std::vector<std::string>& names) {
  const fs::path directory = fresh_folder("moves");
  std::ofstream(directory / "experiment.toml") << "old";
  for (const std::string& name : names) {
    fs::create_directories(directory / "runs" / name);
    std::ofstream(directory / "runs" / name / "row.json") << name;
  }
  return directory;
}

/// What each run was called.
std::map<std::string, std::string> runs_in(const fs::path& directory) {
  std::map<std::string, std::string> runs;
  for (const auto& entry : fs::directory_iterator(directory / "runs"))
    runs[entry.path().filename()] = read_text_file(entry.path() / "row.json");
  return runs;
}

const std::vector<RunMove> kMoves = {{"a", "b"}, {"b", "c"}, {"c", "a"}, {"d", "e"}, {"missing", "f"}};
const std::map<std::string, std::string> kMoved = {
    {"a", "c"}, {"b", "a"}, {"c", "b"}, {"e", "d"}, {"x", "x"}};

void expect_moved(const fs::path& directory, int step) {
  EXPECT_EQ(runs_in(directory), kMoved) << step;
  EXPECT_EQ(read_text_file(directory / "experiment.toml"), "new") << step;
  EXPECT_FALSE(fs::exists(directory / "move_runs.json")) << step;
  EXPECT_FALSE(fs::exists(directory / "moving_runs")) << step;
}

TEST(MoveRuns, KilledAfterAnyStepTheNextProcessFinishesThem) {
  bool was_killed = true;
  int kills = 0;
  for (int last = 1; was_killed; ++last) {
    const fs::path directory = directory_of_runs({"a", "b", "c", "d", "x"});
    int step = 0;
    was_killed = false;
    try {
      move_runs(directory, kMoves, "new", [&] {
        if (++step == last) throw Killed();
      });
    } catch (const Killed&) {
      was_killed = true;
      ++kills;
    }
    finish_moves(directory);
    expect_moved(directory, last);
  }
  EXPECT_EQ(kills, 11) << "the journal twice, four runs twice, the declaration";
}

TEST(MoveRuns, KilledTwiceTooAtAnyTwoSteps) {
  for (int first = 1; first <= 11; ++first)
    for (int second = 1; second <= 11; ++second) {
      const fs::path directory = directory_of_runs({"a", "b", "c", "d", "x"});
      const auto killed_at = [](int last) {
        return [last, step = 0]() mutable {
          if (++step == last) throw Killed();
        };
      };
      EXPECT_THROW(move_runs(directory, kMoves, "new", killed_at(first)), Killed);
      try {
        finish_moves(directory, killed_at(second));
      } catch (const Killed&) {
        finish_moves(directory);
      }
      expect_moved(directory, 100 * first + second);
    }
}

TEST(MoveRuns, AreOfRunsWithTheSameLabels) {
  const auto run = [](const std::string& name, const std::string& seed) {
    return PlannedRun{name, {{"seed", seed}}, nullptr};
  };
  Plan was, is;
  was.runs = {run("one", "1"), run("two", "2"), run("three", "3")};
  is.runs = {run("first", "1"), run("two", "2"), run("one", "4"), run("two-3", "3")};
  const std::vector<RunMove> moves = renamed_runs(was, is);
  ASSERT_EQ(moves.size(), 2u);
  EXPECT_EQ(moves[0].from + " " + moves[0].to, "one first");
  EXPECT_EQ(moves[1].from + " " + moves[1].to, "three two-3");
}

}  // namespace
}  // namespace espalier
