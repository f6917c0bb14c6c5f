// `espalier trials`: a table of what a run evaluated, also of runs of version 0.1, and bad input.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "support/run_espalier.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A run that version 0.1.0 left; its pictures are names in targets/.
fs::path old_run(const std::string& name) {
  const fs::path run = fresh_folder("trials_of_" + name) / name;
  fs::copy(fs::path(ESPALIER_SOURCE_DIR) / "tests/recorded_fits/runs" / name, run);
  return run;
}

ProgramRun run_in_targets(const std::string& arguments) {
  return run_shell("cd '" ESPALIER_SOURCE_DIR "/targets' && '" ESPALIER_PROGRAM "' " + arguments);
}

TEST(TrialsCommand, WritesATableOfRunsOfEarlierVersions) {
  for (const char* name : {"killed", "finished", "space", "branches", "lsystem"}) {
    const fs::path run = old_run(name);
    const auto bytes = fs::file_size(run / "evaluations.bin");
    const ProgramRun done = run_in_targets("trials '" + run.string() + "'");
    ASSERT_EQ(done.exit_code, 0) << name << ": " << done.err;
    const std::string csv = read_text_file(run / "trials.csv");
    EXPECT_EQ(static_cast<std::uintmax_t>(std::count(csv.begin(), csv.end(), '\n')), 1 + (bytes - 8) / 16)
        << name;
    EXPECT_THAT(csv, testing::StartsWith("evaluation,stage,value,seconds,"));
    EXPECT_THAT(done.out, HasSubstr("trials.csv: " + std::to_string((bytes - 8) / 16) + " trials (starts "));
    EXPECT_EQ(fs::file_size(run / "evaluations.bin"), bytes) << name;
  }
}

TEST(TrialsCommand, WritesWhereItIsTold) {
  const fs::path run = old_run("finished");
  const fs::path csv = run.parent_path() / "mine.csv";
  const ProgramRun done = run_in_targets("trials '" + run.string() + "' -o '" + csv.string() + "'");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(fs::exists(csv));
  EXPECT_FALSE(fs::exists(run / "trials.csv"));
}

TEST(TrialsCommand, BadInputIsOneLineAndWritesNothing) {
  const fs::path folder = fresh_folder("trials_command"), run = old_run("finished");
  fs::create_directories(folder / "empty");
  const fs::path no_log = old_run("killed"), no_picture = old_run("space"), other_log = old_run("branches");
  std::ofstream(no_log / "evaluations.bin") << "a shopping list";
  fs::copy_file(run / "evaluations.bin", other_log / "evaluations.bin", fs::copy_options::overwrite_existing);
  const std::pair<std::string, std::string> cases[] = {
      {"", "run"},
      {(folder / "nowhere").string(), "got no directory"},
      {(folder / "empty").string(), "without run.toml"},
      {no_log.string(), "got another kind of file, expected a log of evaluations"},
      {no_picture.string(), ".png"},  // its picture is not in this folder
      {run.string() + " --table x.csv", "--table"}};
  for (const auto& [arguments, message] : cases) {
    const ProgramRun done = run_espalier("trials " + arguments);
    SCOPED_TRACE(arguments);
    expect_one_clear_error(done);
    EXPECT_THAT(done.err, HasSubstr(message));
  }
  const ProgramRun differs = run_in_targets("trials '" + other_log.string() + "'");
  expect_one_clear_error(differs);
  EXPECT_THAT(differs.err, HasSubstr("differs from the one in the log"));
  const ProgramRun unwritable = run_in_targets("trials '" + run.string() + "' -o /nowhere/trials.csv");
  expect_one_clear_error(unwritable);
  EXPECT_THAT(unwritable.err, HasSubstr("/nowhere/trials.csv"));
  for (const fs::path& refused : {no_log, no_picture, other_log, run})
    EXPECT_FALSE(fs::exists(refused / "trials.csv"));
}

}  // namespace
}  // namespace espalier
