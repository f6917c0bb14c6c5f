// One process at a time works in a directory.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <optional>

#include <espalier/core/error.h>
#include <espalier/machine/directory_lock.h>

#include "support/temporary_folders.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

/// The message of a second lock; locks of one process exclude each other as those of two do.
std::string refusal(const fs::path& directory) {
  try {
    const DirectoryLock lock(directory);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(DirectoryLock, LetsOneInAtATime) {
  const fs::path directory = fresh_folder("locked");
  std::optional<DirectoryLock> lock(std::in_place, directory);
  EXPECT_THAT(refusal(directory), testing::HasSubstr("another process works in"));
  lock.reset();
  EXPECT_EQ(refusal(directory), "");
}

TEST(DirectoryLock, MakesNoFileElsewhere) {
  const fs::path directory = fresh_folder("linked");
  fs::create_symlink("elsewhere", directory / kLockName);
  EXPECT_THAT(refusal(directory), testing::HasSubstr("expected a file that can be written"));
  EXPECT_FALSE(fs::exists(directory / "elsewhere"));
}

}  // namespace
}  // namespace espalier
