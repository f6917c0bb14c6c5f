#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <filesystem>
#include <thread>
#include <vector>

#include <espalier/core/error.h>
#include <espalier/core/files.h>

#include "support/temporary_folders.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Files : public testing::Test {
 protected:
  ~Files() override { fs::remove_all(folder_); }

  void expect_refused(const fs::path& path, const std::string& bytes = "new") {
    try {
      write_file_atomically(path, bytes);
      ADD_FAILURE() << path << " was written";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(path.string()));
      EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
    }
  }
  long entries() const { return std::distance(fs::directory_iterator(folder_), {}); }

  fs::path folder_ = fresh_folder("files");
};

TEST_F(Files, BytesReadBackAsTheyWere) {
  std::string bytes(100'000, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * 31);
  write_file_atomically(folder_ / "a", bytes);
  EXPECT_EQ(read_file(folder_ / "a"), bytes);
  write_file_atomically(folder_ / "a", "");
  EXPECT_EQ(read_file(folder_ / "a"), "");
  EXPECT_EQ(entries(), 1);
}

TEST_F(Files, PiecesAreOneFileAndWhereTheyBreakOffTheOldOneStays) {
  write_file_atomically(folder_ / "a", [](const TakeBytes& take) { take("one "), take(""), take("file"); });
  EXPECT_EQ(read_file(folder_ / "a"), "one file");
  EXPECT_THROW(write_file_atomically(folder_ / "a",
                                     [](const TakeBytes& take) {
                                       take("half a");
                                       throw_input_error("no more");
                                     }),
               InputError);
  EXPECT_EQ(read_file(folder_ / "a"), "one file");
  EXPECT_EQ(entries(), 1);
}

TEST_F(Files, UnwritablePathsAreRefusedAndLeaveNothing) {
  write_file_atomically(folder_ / "file", "old");
  fs::create_directory(folder_ / "folder");
  expect_refused(folder_ / "missing" / "a");
  expect_refused(folder_ / "file" / "a");
  expect_refused(folder_ / "folder");
  expect_refused("/proc/espalier");
  EXPECT_EQ(read_file(folder_ / "file"), "old");
  EXPECT_EQ(entries(), 2);
}

TEST_F(Files, AFullDiskLeavesTheOldFile) {
  write_file_atomically(folder_ / "a", "old");
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit limited = before;
  limited.rlim_cur = 1000;  // writes fail after 1000 bytes, as on a disk that fills up
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limited), 0);
  expect_refused(folder_ / "a", std::string(100'000, 'x'));
  expect_refused(folder_ / "b", std::string(100'000, 'x'));
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(read_file(folder_ / "a"), "old");
  EXPECT_EQ(entries(), 1);
}

TEST_F(Files, ADeviceIsWrittenAndNotReplaced) {
  write_file_atomically("/dev/null", "bytes");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  expect_refused("/dev/full");
}

TEST_F(Files, ALinkStaysAndItsFileIsReplaced) {
  write_file_atomically(folder_ / "file", "old");
  fs::create_symlink("file", folder_ / "link");
  write_file_atomically(folder_ / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_EQ(read_file(folder_ / "file"), "new");
}

TEST_F(Files, ReadersSeeTheOldOrTheNewFileWhileThreadsWrite) {
  const std::string contents[] = {std::string(50'000, 'a'), std::string(70'000, 'b')};
  write_file_atomically(folder_ / "a", contents[0]);
  std::vector<std::thread> writers;
  for (int writer = 0; writer < 2; ++writer)
    writers.emplace_back([&, writer] {
      for (int i = 0; i < 50; ++i) write_file_atomically(folder_ / "a", contents[writer]);
    });
  for (int i = 0; i < 50; ++i) {
    const std::string seen = read_file(folder_ / "a");
    EXPECT_TRUE(seen == contents[0] || seen == contents[1]) << seen.size();
  }
  for (std::thread& writer : writers) writer.join();
  EXPECT_EQ(entries(), 1);
}

TEST_F(Files, WhatAKilledProgramLeftHindersNobodyAndGoes) {
  const fs::path old = folder_ / ".a.1-0.tmp", left = folder_ / ".espalier-0123456789abcdef.tmp";
  for (const fs::path& name : {old, left}) std::ofstream(name) << "half a fi";
  std::ofstream(folder_ / "notes.tmp") << "of the user";
  EXPECT_TRUE(is_temporary_name(old) && is_temporary_name(left));
  EXPECT_FALSE(is_temporary_name(folder_ / "notes.tmp") || is_temporary_name(folder_ / ".hidden"));
  write_file_atomically(folder_ / "a", "whole");
  remove_temporary_files(folder_);
  EXPECT_EQ(read_file(folder_ / "a"), "whole");
  EXPECT_EQ(entries(), 2) << "a, notes.tmp";
}

TEST_F(Files, TheirNamesMayBeAsLongAsTheSystemAllows) {
  const fs::path path = folder_ / std::string(255, 'n');
  write_file_atomically(path, "bytes");
  EXPECT_EQ(read_file(path), "bytes");
}

TEST_F(Files, DirectoriesAreMadeWithAllAboveThem) {
  make_directory(folder_ / "a" / "b");
  EXPECT_TRUE(fs::is_directory(folder_ / "a" / "b"));
  make_directory(folder_ / "a" / "b");
  write_file_atomically(folder_ / "file", "");
  EXPECT_THROW(make_directory(folder_ / "file" / "b"), InputError);
}

TEST_F(Files, WhatCannotBeReadIsRefused) {
  EXPECT_THROW(read_file(folder_ / "missing"), InputError);
  EXPECT_THROW(read_file(folder_), InputError);
}

TEST_F(Files, PipesAndDevicesAreNotOpened) {
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  for (const fs::path& path : {folder_ / "pipe", fs::path("/dev/zero")}) {
    EXPECT_THAT([&] { read_file(path); }, testing::ThrowsMessage<InputError>(
                                              testing::HasSubstr("is a pipe or a device, expected a file")));
    EXPECT_THROW(read_beginning(path, 10), InputError) << path;
  }
}

TEST_F(Files, ReadingHasABound) {
  write_file_atomically(folder_ / "a", std::string(1000, 'x'));
  EXPECT_EQ(read_file(folder_ / "a", 1000).size(), 1000u);
  EXPECT_THROW(read_file(folder_ / "a", 999), InputError);
  EXPECT_EQ(read_beginning(folder_ / "a", 10), std::string(10, 'x'));
  EXPECT_EQ(read_beginning(folder_ / "a", 2000), std::string(1000, 'x'));
  EXPECT_FALSE(read_file("/proc/self/status").empty());  // it claims to be empty
  EXPECT_THROW(read_file("/proc/self/status", 10), InputError);
}

}  // namespace
}  // namespace espalier
