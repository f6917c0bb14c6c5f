// Runs that were broken off by a machine that failed, or that come from strangers: they go on to the same
// bits, say what was not sound, and write nowhere else.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include <espalier/core/error.h>
#include <espalier/core/random.h>
#include <espalier/fitting/branches/branch_rounds.h>
#include <espalier/fitting/run/fit.h>
#include <espalier/fitting/search/evaluation_log.h>
#include <espalier/machine/directory_lock.h>
#include <espalier/models/models.h>

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

/// A file with one other bit, the `draw`-th of a fixed sequence.
void flip_a_bit(const fs::path& file, std::uint64_t draw) {
  std::string bytes = read_text_file(file);
  const std::size_t bit = child_key(root_key(17), draw).value % (8 * bytes.size());
  bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << bit % 8));
  std::ofstream(file, std::ios::binary) << bytes;
}

TEST_F(BrokenRun, WithAnyOtherBitIsRefusedOrEndsTheSame) {
  for (const char* name : {"run.toml", "branches.json", "evaluations.bin", "picture.png", "target.png"})
    for (std::uint64_t draw = 0; draw < 8; ++draw) {
      SCOPED_TRACE(fmt::format("{}, {}", name, draw));
      fs::remove_all(run);
      fs::copy(whole, run, fs::copy_options::recursive);
      flip_a_bit(run / name, draw);
      const std::string refused = refusal();
      EXPECT_EQ(refused.find('\n'), std::string::npos);
      if (refused == "none") expect_same_result();
    }
}

/// Calls `look` with the file's bytes once for each of their bits, which is another one then.
template <typename Look>
void for_each_other_bit(const fs::path& file, const Look& look) {
  std::string bytes = read_text_file(file);
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    const auto flip = [&] { bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << bit % 8)); };
    flip();
    std::ofstream(file, std::ios::binary) << bytes;
    try {
      look(bytes);
    } catch (const InputError&) {  // noticed
    }
    flip();
    if (testing::Test::HasFailure()) FAIL() << file << ", bit " << bit;
  }
}

/// All that goes on with a run reads, but for pictures and models, whose hashes the record holds: FNV-1a has
/// another value for each other bit, since each of its steps is a bijection.
TEST_F(BrokenRun, EachOtherBitOfItsStateIsNoticedOrWithoutEffect) {
  const RecordedRun unbroken = read_record(run / "run.toml");
  for_each_other_bit(run / "run.toml", [&](const std::string&) {
    const RecordedRun read = read_record(run / "run.toml");
    EXPECT_TRUE(record_to_toml(read.record, read.outcome) ==
                record_to_toml(unbroken.record, unbroken.outcome));
  });
  const auto logged = read_evaluation_log(run / "evaluations.bin").evaluations;
  for_each_other_bit(run / "evaluations.bin", [&](const std::string&) {
    const LogContent read = read_evaluation_log(run / "evaluations.bin");
    EXPECT_TRUE(read.is_damaged && read.evaluations.size() < logged.size() &&
                std::equal(read.evaluations.begin(), read.evaluations.end(), logged.begin()));
  });
  const Model& model = model_by_name("weber_penn");
  const auto state_of = [&](const std::string& text) {
    return branch_rounds_to_json(branch_rounds_from_json(text, model.table(), "branches.json"), "weber_penn");
  };
  const std::string state = state_of(read_text_file(run / "branches.json"));
  for_each_other_bit(run / "branches.json",
                     [&](const std::string& bytes) { EXPECT_TRUE(state_of(bytes) == state); });
}

TEST_F(BrokenRun, WithAnotherObjectiveInItsRecordIsRefused) {
  std::string text = read_text_file(run / "run.toml");
  const std::size_t at = text.find("0.5*iou");
  ASSERT_NE(at, std::string::npos);
  text.replace(at, 7, "0.4*iou");
  std::ofstream(run / "run.toml", std::ios::binary) << text;
  EXPECT_THAT(refusal(), HasSubstr("check: got a record that was changed since the run wrote it"));
}

/// Of the user's own files, whose names are no UTF-8.
FitRecord record_of_latin1_names(const fs::path& folder) {
  FitRecord record = refined_record();
  const fs::path picture = folder / "b\xe4um.p\xffg", start = folder / "b\xe4um.toml";
  fs::copy_file(record.views[0].picture, picture);
  std::ofstream(start) << "extends = \"quaking_aspen\"\nflare = 0.125\n";
  record.views[0].picture = picture;
  record.start = start;
  record.budget = {20, 0, 0, 0};
  return record;
}

TEST_F(BrokenRun, OfNamesThatAreNoUtf8GoesOn) {
  const fs::path folder = fresh_folder("latin1");
  run = folder / "r\xfcn";
  fit(record_of_latin1_names(folder), run);
  const std::string best = read_text_file(run / "best.toml");
  EXPECT_THAT(best, HasSubstr("b\\\\xe4um"));
  fs::remove(folder / "b\xe4um.p\xffg");
  fs::remove(folder / "b\xe4um.toml");
  go_on();
  EXPECT_EQ(read_text_file(run / "best.toml"), best);
}

TEST_F(BrokenRun, WithAnotherPresetThanItWasBegunFromIsRefused) {
  const fs::path folder = fresh_folder("other_preset");
  run = folder / "run";
  fit(record_of_latin1_names(folder), run);
  std::ofstream(run / "presets/b\\xe4um.toml", std::ios::app) << "# changed\n";
  EXPECT_THAT(refusal(), HasSubstr("got a file that was changed since the run began"));
}

}  // namespace
}  // namespace espalier
