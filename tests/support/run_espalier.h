// Runs the program as a user does and keeps what it printed, for tests of exit codes and messages.
// Of test programs that RUNS_PROGRAM names in tests/CMakeLists.txt.
#pragma once
#include <string>

#include "support/temporary_folders.h"

namespace espalier {

struct ProgramRun {
  int exit_code = -1;  ///< -1 where a signal ended it
  std::string out, err;
};

/// Runs a shell command line, without standard input.
ProgramRun run_shell(const std::string& command);

/// Runs the program with these arguments, written as in a shell and without standard input. The program runs
/// in a process of its own, which is a fork of this one: the first picture of the real one takes 0.3 s, spent
/// on OpenImageIO's libraries. What a shell has to do (pipes, redirections) is done by a shell, with the real
/// one.
ProgramRun run_espalier(const std::string& arguments);

/// Starts the real program through the shell, sends `signal` after `delay_ms`, returns its wait status.
int run_and_signal(const std::string& command, int delay_ms, int signal);

/// The same with an interrupt, `delay_ms` after the file `begun` is there: on a busy machine that takes its
/// time.
int run_and_interrupt(const std::string& command, const std::filesystem::path& begun, int delay_ms,
                      int signal = SIGINT);

/// The contract for bad input: exit code 2, nothing on stdout, one line on stderr.
void expect_one_clear_error(const ProgramRun& run);

}  // namespace espalier
