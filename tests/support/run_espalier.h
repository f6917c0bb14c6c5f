// Runs the program as a user does and keeps what it printed, for tests of exit codes and messages.
#pragma once
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace espalier {

struct ProgramRun {
  int exit_code = -1;  ///< -1 where a signal ended it
  std::string out, err;
};

inline std::string read_text_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Folders that vanish when the program ends, unless a test failed: then they are there to be looked at.
class TemporaryFolders {
 public:
  ~TemporaryFolders() {
    std::error_code ignored;
    if (testing::UnitTest::GetInstance()->Passed())
      for (const auto& folder : folders_) std::filesystem::remove_all(folder, ignored);
  }
  void add(const std::filesystem::path& folder) { folders_.push_back(folder); }

 private:
  std::vector<std::filesystem::path> folders_;
};

/// A folder of this test process alone, made empty.
inline std::filesystem::path fresh_folder(const std::string& name) {
  const auto folder =
      std::filesystem::path(testing::TempDir()) / ("espalier_" + std::to_string(getpid()) + "_" + name);
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  static TemporaryFolders made;
  made.add(folder);
  return folder;
}

/// Runs a shell command line, without standard input.
inline ProgramRun run_shell(const std::string& command) {
  const auto folder = fresh_folder("run");
  const auto out = folder / "out", err = folder / "err";
  const int status = std::system(
      ("{ " + command + "\n} </dev/null >'" + out.string() + "' 2>'" + err.string() + "'").c_str());
  ProgramRun run{WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text_file(out), read_text_file(err)};
  std::filesystem::remove_all(folder);
  return run;
}

/// Runs the program with these arguments, written as in a shell.
inline ProgramRun run_espalier(const std::string& arguments) {
  return run_shell("'" ESPALIER_PROGRAM "' " + arguments);
}

/// Starts the program through the shell, sends `signal` after `delay_ms`, returns its wait status.
inline int run_and_signal(const std::string& command, int delay_ms, int signal) {
  const pid_t child = fork();
  if (child == 0) {
    const std::string line = "exec '" ESPALIER_PROGRAM "' " + command + " >/dev/null 2>&1";
    execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
    _exit(127);
  }
  usleep(static_cast<useconds_t>(delay_ms) * 1000);
  kill(child, signal);
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

/// The contract for bad input: exit code 2, nothing on stdout, one line on stderr.
inline void expect_one_clear_error(const ProgramRun& run) {
  EXPECT_EQ(run.exit_code, 2) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
}

}  // namespace espalier
