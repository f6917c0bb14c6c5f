// Runs that were moved, and whose pictures are gone: they go on, and are repeated, from what is in their
// directory. Those of earlier versions, which hold no picture, are told where theirs is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "support/run_espalier.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const fs::path kMovedTargets = ESPALIER_SOURCE_DIR "/targets";

/// For a command line.
std::string bundled_target(const std::string& name) {
  return fmt::format("'{}'", (kMovedTargets / name).string());
}

void copy_target(const std::string& name, const fs::path& to) {
  fs::copy_file(kMovedTargets / name, to, fs::copy_options::overwrite_existing);
}

/// The arguments of a small fit of `picture`.
std::string small_fit_of(const fs::path& picture, const fs::path& run, int evaluations) {
  return fmt::format(
      "fit '{}' --size 32 --start palm --max-stems 300 --max-leaves 3000 --quiet --evaluations {} "
      "--branch-rounds 1 --train-to-target --out '{}'",
      picture.string(), evaluations, run.string());
}

void expect_it_works(const std::string& arguments) {
  const ProgramRun run = run_espalier(arguments);
  EXPECT_EQ(run.exit_code, 0) << arguments << "\n" << run.err;
}

void expect_it_refuses(const std::string& arguments, const std::string& words) {
  const ProgramRun run = run_espalier(arguments);
  expect_one_clear_error(run);
  EXPECT_THAT(run.err, HasSubstr(words)) << arguments;
}

void expect_same_files(const fs::path& run, const fs::path& other) {
  for (const char* name :
       {"best.toml", "best.png", "tree.png", "outline.png", "overlay_full_size.png", "archive/1.toml"}) {
    ASSERT_TRUE(fs::exists(run / name)) << name;
    EXPECT_TRUE(read_text_file(run / name) == read_text_file(other / name)) << name;
  }
}

/// A run of 15 evaluations that was moved, and whose picture was deleted; beside it one of 40 of the same
/// picture.
struct MovedRun : testing::Test {
  static void SetUpTestSuite() {
    folder = fresh_folder("moved_run");
    copy_target("oc_palm.png", folder / "tree.png");
    expect_it_works(small_fit_of(folder / "tree.png", folder / "whole", 40));
    expect_it_works(small_fit_of(folder / "tree.png", folder / "run", 15));
    fs::create_directory(folder / "elsewhere");
    fs::rename(folder / "run", folder / "elsewhere/short");
    fs::remove(folder / "tree.png");
  }
  /// A copy of the short run for a test of its own.
  static fs::path short_run(const std::string& name) {
    const fs::path run = folder / name;
    fs::copy(folder / "elsewhere/short", run, fs::copy_options::recursive);
    return run;
  }

  static inline fs::path folder;
};

TEST_F(MovedRun, GoesOnToTheSameBits) {
  const fs::path run = short_run("resumed");
  expect_it_works("fit --quiet --evaluations 40 --resume '" + run.string() + "'");
  expect_same_files(run, folder / "whole");
}

TEST_F(MovedRun, IsRepeatedToTheSameBitsAndTheRepetitionIsComplete) {
  const fs::path run = short_run("origin"), again = folder / "again", third = folder / "third";
  expect_it_works("fit --quiet --repeat '" + run.string() + "' --out '" + again.string() + "'");
  expect_same_files(run, again);
  fs::rename(run, folder / "origin_moved");
  expect_it_works("fit --quiet --repeat '" + again.string() + "' --out '" + third.string() + "'");
  expect_same_files(again, third);
}

TEST_F(MovedRun, HasItsTrials) { expect_it_works("trials '" + short_run("trials").string() + "'"); }

TEST_F(MovedRun, IgnoresAnotherPictureWhereItsOwnWas) {
  const fs::path run = short_run("beside_another");
  copy_target("oc_cypress.png", folder / "tree.png");
  expect_it_works("fit --quiet --evaluations 40 --resume '" + run.string() + "'");
  expect_same_files(run, folder / "whole");
  fs::remove(folder / "tree.png");
}

TEST_F(MovedRun, RefusesAnotherPicture) {
  const fs::path run = short_run("other_given");
  const std::string before = read_text_file(run / "run.toml");
  const std::string other = (kMovedTargets / "oc_cypress.png").string(),
                    palm = (kMovedTargets / "oc_palm.png").string();
  for (const char* verb : {"--resume", "--repeat"}) {
    const std::string run_of = fmt::format("fit {} '{}' ", verb, run.string());
    expect_it_refuses(run_of + "--picture " + other, "oc_cypress.png' of 1931 bytes (hash ");
    expect_it_refuses(run_of + "--picture " + other, "expected the picture of the run, of 3538 bytes");
    expect_it_refuses(run_of + "--picture /nowhere.png",
                      "--picture: got '/nowhere.png', expected a picture's");
    expect_it_refuses(run_of + fmt::format("--picture {} --picture {}", palm, palm),
                      "got 2 pictures, expected 1");
  }
  EXPECT_EQ(read_text_file(run / "run.toml"), before);
}

TEST_F(MovedRun, WhoseCopyWasSpoiledSaysWhatItHas) {
  const fs::path run = short_run("spoiled_copy");
  copy_target("oc_cypress.png", run / "picture.png");
  const std::string resume = "fit --quiet --evaluations 40 --resume '" + run.string() + "'";
  expect_it_refuses(resume, "picture.png' is another picture, ");
  expect_it_refuses(resume, "tree.png' is not there: expected the picture of the run in ");
  expect_it_works(resume + " --picture " + bundled_target("oc_palm.png"));
  expect_same_files(run, folder / "whole");
  EXPECT_EQ(read_text_file(run / "picture.png"), read_text_file(kMovedTargets / "oc_palm.png"));
}

/// Names between backquotes, as the page of a run's directory writes them.
void expect_on_page(const std::string& name) {
  static const std::string page = read_text_file(ESPALIER_SOURCE_DIR "/docs/run_directory.md");
  EXPECT_THAT(page, HasSubstr("`" + name + "`"));
}

/// Of the archive, behind the first.
bool is_further_solution(const fs::path& file) {
  return file.parent_path().filename() == "archive" && file.extension() == ".toml" && file.stem() != "1";
}

TEST_F(MovedRun, HasNoFileKeyOrColumnThatItsPageLeavesOut) {
  const fs::path run = folder / "whole";
  for (const auto& file : fs::recursive_directory_iterator(run))
    if (file.is_regular_file() && !is_further_solution(file))
      expect_on_page(fs::relative(file, run).string());
  const auto summary = nlohmann::json::parse(read_text_file(run / "summary.json"));
  for (const auto& [key, value] : summary.items()) expect_on_page(key);
  std::string columns = read_text_file(run / "trace.csv");
  std::istringstream names(columns.substr(0, columns.find('\n')));
  for (std::string name; std::getline(names, name, ',');) expect_on_page(name);
}

/// A folder with an L-system of the user's that includes another file, and a preset of it.
fs::path own_models(const std::string& name) {
  const fs::path folder = fresh_folder(name) / "models";
  fs::create_directory(folder);
  std::ofstream(folder / "reeds.lsys") << "param angle = 20 in 5 .. 60 deg \"of the blades\"\n"
                                          "include \"blades.lsys\"\nsteps: 6\naxiom: A\n";
  std::ofstream(folder / "blades.lsys") << "productions:\n  A --> F(1,0.05)[+(angle)A][-(angle)A]\n";
  std::ofstream(folder / "steep.toml") << "model = \"reeds.lsys\"\nangle = 12\n";
  return folder;
}

TEST(MovedRunOfAnOwnLSystem, GoesOnRepeatsAndGrowsWithoutTheFilesItWasMadeOf) {
  const fs::path models = own_models("own_lsystem"), folder = models.parent_path();
  const auto begin = [&](const std::string& run, int evaluations) {
    expect_it_works(
        fmt::format("fit {0} --model '{1}/../models/reeds.lsys' --start '{1}/steep.toml' --size 32 --quiet "
                    "--evaluations {2} --branch-rounds 1 --out '{3}'",
                    bundled_target("oc_palm.png"), models.string(), evaluations, (folder / run).string()));
  };
  begin("whole", 30);
  begin("short", 15);
  fs::remove_all(models);
  fs::rename(folder / "short", folder / "moved");
  expect_it_works(fmt::format("fit --quiet --evaluations 30 --resume '{}'", (folder / "moved").string()));
  expect_it_works(fmt::format("fit --quiet --repeat '{}' --out '{}'", (folder / "whole").string(),
                              (folder / "again").string()));
  for (const char* run : {"moved", "again"})
    for (const char* file :
         {"best.toml", "best.png", "archive/1.toml", "model/blades.lsys", "presets/steep.toml"})
      EXPECT_EQ(read_text_file(folder / run / file), read_text_file(folder / "whole" / file)) << run << file;
  for (const char* tree : {"best.toml", "archive/1.toml"})
    expect_it_works(
        fmt::format("mask '{}' -o '{}'", (folder / "moved" / tree).string(), (folder / "mask.png").string()));
}

TEST(FitCommand, PrintsItsSummaryAsJson) {
  const fs::path run = fresh_folder("json") / "run";
  const ProgramRun done = run_espalier(small_fit_of(kMovedTargets / "oc_palm.png", run, 10) + " --json");
  nlohmann::json printed = nlohmann::json::parse(done.out);
  EXPECT_EQ(printed["directory"], run.string());
  printed.erase("directory");
  EXPECT_EQ(printed, nlohmann::json::parse(read_text_file(run / "summary.json")));
}

TEST(RunOfVersion01, IsToldWhereItsPictureIsAndKeepsIt) {
  const fs::path run = fresh_folder("old_run") / "finished";
  fs::copy(ESPALIER_SOURCE_DIR "/tests/recorded_fits/runs/finished", run);
  const std::string resume = "fit --quiet --evaluations 310 --resume '" + run.string() + "'";
  expect_it_refuses(resume,
                    "--picture: got none, and 'fir.png' is not there: expected the picture of the run");
  expect_it_refuses(resume + " --picture " + bundled_target("oc_palm.png"), "got another picture than");
  EXPECT_FALSE(fs::exists(run / "picture.png"));
  expect_it_works(resume + " --picture " + bundled_target("fir.png"));
  EXPECT_TRUE(read_text_file(run / "picture.png") == read_text_file(kMovedTargets / "fir.png"));
}

TEST(Picture, IsOfARunThatIsReadAgain) {
  expect_it_refuses("fit " + bundled_target("oc_palm.png") + " --picture a.png",
                    "--picture: got neither --resume nor --repeat");
}

}  // namespace
}  // namespace espalier
