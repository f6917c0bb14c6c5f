// espalier fit as a user meets it: a directory, one clear line for bad input, and runs that survive
// being killed at any moment.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include <espalier/fitting/record/fit_options.h>
#include <espalier/fitting/record/option_values.h>

#include "support/option_samples.h"
#include "support/run_espalier.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string kPalm = "'" ESPALIER_SOURCE_DIR "/targets/oc_palm.png'";
const std::string kSmall =
    kPalm + " --size 32 --start palm --max-stems 300 --max-leaves 3000 --threads 2 --quiet ";

/// A small fit into `run` of this many evaluations, and of one round of branches.
std::string small_fit(const fs::path& run, long evaluations, const std::string& more = "",
                      const std::string& rounds = "1") {
  return fmt::format("fit {}--evaluations {} --branch-rounds {} --out '{}' {}", kSmall, evaluations, rounds,
                     run.string(), more);
}

std::string trace_without_seconds(const fs::path& run) {
  std::istringstream csv(read_text_file(run / "trace.csv"));
  std::string text;
  for (std::string line; std::getline(csv, line);) {
    const auto first = line.find(','), second = line.find(',', first + 1);
    text += line.substr(0, first) + line.substr(second) + "\n";
  }
  return text;
}

void expect_error(const std::string& arguments, const std::string& words) {
  const ProgramRun run = run_espalier("fit " + arguments);
  expect_one_clear_error(run);
  EXPECT_THAT(run.err, HasSubstr(words)) << arguments;
}

TEST(FitCommand, FitsAndSaysWhereTheFilesAre) {
  const fs::path run = fresh_folder("plain") / "run";
  const ProgramRun done = run_espalier(
      "fit " + kPalm + " --size 32 --start palm --evaluations 30 --branch-rounds 1 --out " + run.string());
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr(run.string()));
  EXPECT_THAT(done.out, HasSubstr("IoU"));
  EXPECT_THAT(done.err, HasSubstr("evaluations"));
  EXPECT_EQ(done.err.find('\r'), std::string::npos) << "plain lines where there is no terminal";
}

TEST(FitCommand, IsSilentWhenQuiet) {
  const ProgramRun done = run_espalier(small_fit(fresh_folder("quiet") / "run", 20));
  EXPECT_EQ(done.exit_code, 0);
  EXPECT_EQ(done.out + done.err, "");
}

TEST(FitCommand, AKilledRunIsValidAndResumesToTheUnbrokenRun) {
  const fs::path folder = fresh_folder("kill");
  ASSERT_EQ(run_espalier(small_fit(folder / "unbroken", 600, "", "4")).exit_code, 0);
  std::mt19937 random(std::random_device{}());
  const fs::path broken = folder / "broken";
  int kills = 0;
  for (int attempt = 0; attempt < 6; ++attempt) {
    const int delay_ms = 100 + static_cast<int>(random() % 700);
    const bool resume = fs::exists(broken / "run.toml");
    const std::string command =
        resume ? "fit --quiet --resume '" + broken.string() + "'" : small_fit(broken, 600, "", "4");
    if (!resume) fs::remove_all(broken);
    kills += WIFSIGNALED(run_and_signal(command, delay_ms, SIGKILL));
    if (fs::exists(broken / "summary.json")) {
      EXPECT_TRUE(nlohmann::json::accept(read_text_file(broken / "summary.json")));
    }
  }
  EXPECT_GT(kills, 0) << "no run lived long enough to be killed";
  if (!fs::exists(broken / "run.toml")) GTEST_SKIP() << "killed each time before it began";
  ASSERT_EQ(run_espalier("fit --quiet --resume '" + broken.string() + "'").exit_code, 0);
  EXPECT_EQ(read_text_file(broken / "best.toml"), read_text_file(folder / "unbroken" / "best.toml"));
  EXPECT_EQ(trace_without_seconds(broken), trace_without_seconds(folder / "unbroken"));
}

TEST(FitCommand, CtrlCWritesTheResultAndTheRunRepeatsByItsCount) {
  const fs::path folder = fresh_folder("interrupt"), run = folder / "run";
  const std::string endless = "fit " + kSmall + "--seconds 1000 --out '" + run.string() + "'";
  const int status = run_and_interrupt(endless, run / "run.toml", 300);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  const auto summary = nlohmann::json::parse(read_text_file(run / "summary.json"));
  EXPECT_EQ(summary["stopped_by"], "interrupted");
  const std::string rounds = summary["branch_rounds"].dump();
  ASSERT_EQ(run_espalier(small_fit(folder / "by_count", summary["evaluations"], "", rounds)).exit_code, 0);
  EXPECT_EQ(read_text_file(folder / "by_count" / "best.toml"), read_text_file(run / "best.toml"));
  const std::string repeat =
      "fit --quiet --repeat '" + run.string() + "' --out '" + (folder / "again").string() + "'";
  ASSERT_EQ(run_espalier(repeat).exit_code, 0);
  EXPECT_EQ(read_text_file(folder / "again" / "best.toml"), read_text_file(run / "best.toml"));
}

struct EndingSignal : testing::TestWithParam<int> {};

TEST_P(EndingSignal, LeavesAFinishedDirectoryLikeCtrlC) {
  const fs::path run = fresh_folder("signal") / "run";
  const std::string endless = "fit " + kSmall + "--seconds 1000 --out '" + run.string() + "'";
  const int status = run_and_interrupt(endless, run / "run.toml", 300, GetParam());
  ASSERT_TRUE(WIFEXITED(status)) << "it was killed";
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_EQ(nlohmann::json::parse(read_text_file(run / "summary.json"))["stopped_by"], "interrupted");
  EXPECT_THAT(read_text_file(run / "run.toml"), HasSubstr("stopped_by = \"interrupted\""));
}

INSTANTIATE_TEST_SUITE_P(OfSystems, EndingSignal, testing::Values(SIGTERM, SIGHUP, SIGUSR1, SIGXCPU));

TEST(FitCommand, BehindNohupGoesOnAfterAHangUp) {
  const fs::path run = fresh_folder("nohup") / "run";
  const ProgramRun done =
      run_shell("trap '' HUP; '" ESPALIER_PROGRAM "' fit " + kSmall + "--seconds 1.5 --out '" + run.string() +
                "' & sleep 0.7; kill -HUP $!; wait $!");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(nlohmann::json::parse(read_text_file(run / "summary.json"))["stopped_by"], "time");
}

TEST(FitCommand, RefusesBadOptionsInOneLine) {
  const std::string out = " --out " + (fresh_folder("bad") / "run").string();
  expect_error(kPalm + out + " --optimizer cma", "cma_es");
  expect_error(kPalm + out + " --evaluations 0", "--evaluations");
  expect_error(kPalm + out + " --seconds 0", "--seconds");
  expect_error(kPalm + out + " --seconds -3", "--seconds");
  expect_error(kPalm + out + " --seconds nan", "--seconds");
  expect_error(kPalm + out + " --seed x", "--seed");
  expect_error(kPalm + out + " --free g_scal", "g_scale");
  expect_error(kPalm + out + " --objective iuo", "iou");
  expect_error(kPalm + out + " --start oak_of_nowhere", "oak_of_nowhere");
  expect_error(kPalm + out + " --set-optimizer nope=1", "nope");
  expect_error(kPalm + out + " --views nothing.png:90", "AZIMUTH");
  expect_error(kPalm + out + " --fit-seeds 0", "--fit-seeds");
  expect_error(kPalm + out + " --target-fitness 7", "--target-fitness");
  expect_error(kPalm + out + " --max-stems 1e7 --max-leaves 1e7 --threads 1024", "GB of memory");
  for (const char* value : {"nan", "inf", "1e308", "-inf", "1e999", "", "twelve", "99999"})
    expect_error(kPalm + out + " --fix g_scale=" + value, "g_scale");
  EXPECT_FALSE(fs::exists(fs::path(out.substr(7)))) << "nothing is left behind";
}

/// What no option of this kind takes.
std::vector<std::string> bad_words(const FitOption& option) {
  switch (type_of(option)) {
    case ValueType::whole:
      return {"many", "2.5", "0x10", "''"};
    case ValueType::number:
      return {"many", "nan", "inf", "0x10", "''"};
    default:
      return {};
  }
}

TEST(FitCommand, EachOptionIsToldByItsNameWhatItCannotTake) {
  const fs::path run = fresh_folder("each") / "run";
  for (const FitOption& option : fit_options()) {
    if (option.option.empty()) continue;
    std::vector<std::string> words = bad_words(option);
    for (const std::string& bad : sample_of(option).bad)
      if (bad.find('[') == std::string::npos)
        words.push_back(bad);  // a TOML string's quotes are the shell's too
    const std::string name = fmt::format("--{}", option.option);
    for (const std::string& word : words)
      expect_error(kPalm + " --out '" + run.string() + "' " + name + " " + word, name + ": got ");
  }
  EXPECT_FALSE(fs::exists(run));
}

TEST(FitCommand, EachOptionIsInItsHelp) {
  const std::string help = run_espalier("fit --help").out;
  for (const FitOption& option : fit_options()) {
    if (option.option.empty()) continue;
    EXPECT_THAT(help, HasSubstr(fmt::format("  --{} ", option.option)));
  }
}

TEST(FitCommand, ChoicesAreFixedByTheirNames) {
  const fs::path run = fresh_folder("choice") / "run";
  ASSERT_EQ(run_espalier(small_fit(run, 5, "--fix leaf_shape=ovate")).exit_code, 0);
  EXPECT_THAT(read_text_file(run / "run.toml"), HasSubstr("\"leaf_shape\" = 1.0"));
  expect_error(kPalm + " --fix leaf_shape=0x3", "--fix: got '0x3' for leaf_shape, expected one of ");
  expect_error(kPalm + " --set-optimizer population=0x10", "--set-optimizer: got '0x10' for population");
}

TEST(FitCommand, ASpeciesThatIsNoneIsRefused) {
  expect_error(kPalm + " --species no_such_tree", "--species: ");
  expect_error(kPalm + " --model small_pine.lsys --species apple",
               "--species: got 'apple' of model weber_penn, expected a preset of small_pine");
}

TEST(FitCommand, AStartBeyondTheBudgetIsSaidToBe) {
  const fs::path run = fresh_folder("beyond") / "run";
  const ProgramRun done =
      run_espalier(fmt::format("fit {}/targets/fir.png --start quaking_aspen --stages starts --max-leaves "
                               "100 --evaluations 5 --size 64 --out {}",
                               ESPALIER_SOURCE_DIR, run.string()));
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.err, HasSubstr("espalier: warning: start 'quaking_aspen': got "));
  EXPECT_THAT(done.err, HasSubstr("expected at most 6000 and 100: it was not grown"));
}

TEST(FitCommand, ResumeTakesTheOptionsThatARunMayChange) {
  for (const FitOption& option : fit_options()) {
    if (option.option.empty()) continue;
    const bool flag = type_of(option) == ValueType::flag;
    const std::string given = fmt::format(" --{}{}", option.option, flag ? "" : " 1");
    const ProgramRun resumed = run_espalier("fit --resume /nowhere" + given);
    EXPECT_EQ(resumed.err.find("expected one of the two") == std::string::npos, option.resumable)
        << resumed.err;
    EXPECT_THAT(run_espalier("fit --repeat /nowhere" + given).err, HasSubstr("expected one of the two"));
  }
}

TEST(FitCommand, ARecordThatWasSpoiledIsToldItsFileLineAndKey) {
  const fs::path run = fresh_folder("spoiled") / "run";
  ASSERT_EQ(run_espalier(small_fit(run, 5)).exit_code, 0);
  std::string text = read_text_file(run / "run.toml");
  const std::string line = "\nsize_px = 32";
  ASSERT_NE(text.find(line), std::string::npos);
  text.replace(text.find(line), line.size(), "\nsize_px = 8");
  std::ofstream(run / "run.toml") << text;
  expect_error("--resume '" + run.string() + "'",
               "run.toml:22: target.size_px: got 8, expected a whole number 16..4096 (px)");
}

TEST(FitCommand, AcceptsMinusZeroAsZero) {
  const fs::path run = fresh_folder("zero") / "run";
  EXPECT_EQ(run_espalier(small_fit(run, 5, "--fix flare=-0")).exit_code, 0);
  EXPECT_THAT(read_text_file(run / "best.toml"), testing::Not(HasSubstr("-0.0\n")));
}

TEST(FitCommand, RefusesPicturesThatAreNone) {
  const fs::path folder = fresh_folder("pictures");
  std::ofstream(folder / "empty.png").flush();
  std::ofstream(folder / "text.png") << "this is no picture";
  const std::string out = " --out " + (folder / "run").string();
  expect_error((folder / "missing.png").string() + out, "missing.png");
  expect_error((folder / "empty.png").string() + out, "empty.png");
  expect_error((folder / "text.png").string() + out, "text.png");
  EXPECT_FALSE(fs::exists(folder / "run"));
}

TEST(FitCommand, RefusesDirectoriesItCannotMake) {
  const fs::path folder = fresh_folder("directories");
  std::ofstream(folder / "file") << "x";
  expect_error(kPalm + " --out " + folder.string(), "with files in it");
  expect_error(kPalm + " --out " + (folder / "file").string(), "got a file");
  expect_error(kPalm + " --out /proc/espalier/run", "/proc/espalier");
}

TEST(FitCommand, ReportsADiskThatFillsUp) {
  const fs::path run = fresh_folder("full") / "run";
  // A limit on the size of files stands in for a full disk: 8 blocks hold the record, not the pictures' end.
  const ProgramRun done = run_shell("ulimit -f 8; '" ESPALIER_PROGRAM "' " + small_fit(run, 2000));
  expect_one_clear_error(done);
}

TEST(FitCommand, RefusesToResumeWhatIsNoRun) {
  expect_error("--resume " + fresh_folder("no_run").string(), "run.toml");
  expect_error("--resume /nowhere/at/all", "/nowhere");
  expect_error("--repeat /nowhere/at/all", "/nowhere");
}

}  // namespace
}  // namespace espalier
