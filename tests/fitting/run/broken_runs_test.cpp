// Runs that were broken off by a machine that failed, or that come from strangers: they go on to the same
// bits, say what was not sound, and write nowhere else.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include <espalier/core/error.h>
#include <espalier/fitting/run/fit.h>
#include <espalier/machine/directory_lock.h>

#include "support/temporary_folders.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

FitRecord refined_record() {
  FitRecord record;
  record.views = {{fs::path(ESPALIER_SOURCE_DIR) / "targets/tr_birch.png", {}}};
  record.target.size_px = 32;
  record.budget = {60, 0, 0, 1};
  record.growth = {150, 600};
  record.start = "quaking_aspen";
  return record;
}

/// A finished run of a search of 60 evaluations and one round of the refinement.
struct BrokenRun : testing::Test {
  static void SetUpTestSuite() {
    whole = fresh_folder("whole") / "run";
    fit(refined_record(), whole);
  }
  BrokenRun() { fs::copy(whole, run, fs::copy_options::recursive); }

  void go_on() {
    warnings.clear();
    FitExecution options;
    options.resume = true;
    options.on_warning = [&](const std::string& text) { warnings.push_back(text); };
    fit(read_record(run / "run.toml").record, run, options);
  }
  void expect_same_result() const {
    for (const char* name : {"best.toml", "best.png", "archive/1.toml", "overlay_full_size.png"})
      EXPECT_TRUE(read_text_file(run / name) == read_text_file(whole / name)) << name;
  }
  std::string refusal() {
    try {
      go_on();
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  }

  static inline fs::path whole;
  fs::path run = fresh_folder("broken") / "run";
  std::vector<std::string> warnings;
};

void write_at(const fs::path& file, std::streamoff at, const std::string& bytes) {
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekp(at) << bytes;
}

TEST_F(BrokenRun, WithZerosInItsLogGoesOnFromBeforeThem) {
  write_at(run / "evaluations.bin", 8 + 24 * 30, std::string(24 * 30, '\0'));  // as power cuts leave them
  go_on();
  expect_same_result();
  EXPECT_THAT(warnings,
              ElementsAre(HasSubstr("evaluation 31 is damaged: the run goes on from the 30 before it"),
                          HasSubstr("after 60 evaluations, of which the log holds 30")));
  go_on();
  EXPECT_THAT(warnings, IsEmpty()) << "it is mended";
}

TEST_F(BrokenRun, WithoutASoundStateOfItsRefinementMakesItAnew) {
  for (const std::string& text :
       {std::string(), std::string(100, '\0'), std::string("{}"), std::string("{\"rounds\": 1")}) {
    std::ofstream(run / "branches.json", std::ios::binary) << text;
    go_on();
    expect_same_result();
    EXPECT_THAT(warnings, ElementsAre(HasSubstr("the refinement begins anew"))) << text;
  }
}

TEST_F(BrokenRun, IsNotHinderedByWhatAKilledProcessLeft) {
  std::ofstream(run / ".run.toml.1-0.tmp") << "half";
  std::ofstream(run / "archive/.espalier-0011223344556677.tmp") << "half";
  go_on();
  expect_same_result();
  EXPECT_FALSE(fs::exists(run / ".run.toml.1-0.tmp"));
  EXPECT_FALSE(fs::exists(run / "archive/.espalier-0011223344556677.tmp"));
}

TEST_F(BrokenRun, ThatWasKilledBeforeItsRecordWasThereIsANewOne) {
  const fs::path fresh = fresh_folder("first_moments") / "run";
  fs::create_directory(fresh);
  std::ofstream(fresh / ".espalier-0011223344556677.tmp") << "half";
  { const DirectoryLock lock(fresh); }
  std::ofstream(fresh / "picture.png") << "another one";
  fs::create_directory(fresh / "model");
  fit(refined_record(), fresh);
  EXPECT_TRUE(read_text_file(fresh / "best.toml") == read_text_file(whole / "best.toml"));
}

TEST_F(BrokenRun, IsNoDirectoryOfTheUsers) {
  const fs::path own = fresh_folder("own_directory");
  std::ofstream(own / "picture.png") << "of the user";
  EXPECT_THROW(fit(refined_record(), own), InputError);
  EXPECT_EQ(read_text_file(own / "picture.png"), "of the user");
  EXPECT_FALSE(fs::exists(own / kLockName));
}

TEST_F(BrokenRun, OfAStrangerReplacesNoFileElsewhere) {
  const fs::path precious = run.parent_path() / "precious";
  std::ofstream(precious) << "kept";
  for (const char* name : {"best.toml", "archive/1.toml", "lock"}) {
    fs::remove(run / name);
    fs::create_symlink(precious, run / name);
    EXPECT_THAT(refusal(), HasSubstr(std::string(name) + ": got a link, expected a file of the run"));
    fs::remove(run / name);
  }
  EXPECT_EQ(read_text_file(precious), "kept");
}

TEST_F(BrokenRun, IsOneProcesssAtATime) {
  const DirectoryLock lock(run);
  const std::string before = read_text_file(run / "run.toml");
  EXPECT_THAT(refusal(), HasSubstr("another process works in"));
  EXPECT_EQ(read_text_file(run / "run.toml"), before);
}

}  // namespace
}  // namespace espalier
