// Where data is looked for: where the user says, beside the program, then elsewhere; and that a message names
// all of these places.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include <espalier/core/data_path.h>
#include <espalier/core/error.h>
#include <espalier/core/files.h>

#include "support/temporary_folders.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Names this folder in the environment for as long as it lives.
class ChosenDataFolder {
 public:
  explicit ChosenDataFolder(const fs::path& folder) { setenv("ESPALIER_DATA_DIR", folder.c_str(), 1); }
  ~ChosenDataFolder() { unsetenv("ESPALIER_DATA_DIR"); }
};

TEST(DataPath, BundledDataIsFoundInABuild) {
  EXPECT_TRUE(fs::exists(data_path("targets") / "fir.png"));
  EXPECT_TRUE(fs::exists(data_path("experiments/report/report.py")));
  EXPECT_TRUE(fs::exists(data_path("lsystem/models") / "obstacle.obj"));
}

TEST(DataPath, TheFolderThatTheUserNamesComesFirst) {
  const fs::path folder = fresh_folder("data_path");
  const ChosenDataFolder chosen(folder);
  write_file_atomically(folder / "targets", "a file");
  EXPECT_EQ(data_path("targets"), folder / "targets");
  EXPECT_NE(data_path("experiments"), folder / "experiments") << "is not there";
}

TEST(DataPath, WhatIsMissingIsAnErrorThatSaysWhereItLooked) {
  const fs::path folder = fresh_folder("data_path_missing");
  const ChosenDataFolder chosen(folder);
  EXPECT_EQ(data_path_or_first("no/such"), folder / "no/such");
  try {
    data_path("no/such");
    FAIL() << "expected an InputError";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr((folder / "no/such").string()));
    EXPECT_THAT(error.what(), HasSubstr("share/espalier/no/such"));
    EXPECT_THAT(error.what(), HasSubstr(ESPALIER_SOURCE_DIR "/no/such"));
  }
}

}  // namespace
}  // namespace espalier
