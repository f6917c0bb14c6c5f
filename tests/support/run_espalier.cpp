#include "support/run_espalier.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <wordexp.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <vector>

#include <espalier/app/main/program.h>
#include <espalier/image/codecs/codecs.h>

namespace espalier {

namespace {

constexpr std::size_t kLongestRequest = 1 << 16;  // bytes

/// A run's streams and arguments, sent as strings that each end with a zero byte.
using Request = std::vector<std::string>;

std::string packed(const Request& request) {
  std::string bytes;
  for (const std::string& word : request) bytes.append(word).push_back('\0');
  return bytes;
}

Request unpacked(const std::string& bytes) {
  Request request;
  for (std::size_t at = 0; at < bytes.size(); at += request.back().size() + 1)
    request.emplace_back(bytes.c_str() + at);
  return request;
}

void redirect(int stream, const std::string& path, int flags) {
  const int file = open(path.c_str(), flags, 0644);
  dup2(file, stream);
  close(file);
}

/// Ends a fork. Not by exit(): log4cplus, which OpenImageIO loads, would wait for threads that a fork has
/// not.
[[noreturn]] void end_run(int exit_code) {
  std::cout.flush();
  std::fflush(nullptr);
  _exit(exit_code);
}

/// In a process of its own. request: files for standard output and error, then the arguments.
[[noreturn]] void run_here(const Request& request) {
  redirect(STDIN_FILENO, "/dev/null", O_RDONLY);
  redirect(STDOUT_FILENO, request.at(0), O_WRONLY | O_CREAT | O_TRUNC);
  redirect(STDERR_FILENO, request.at(1), O_WRONLY | O_CREAT | O_TRUNC);
  std::vector<const char*> arguments = {"espalier"};
  for (std::size_t i = 2; i < request.size(); ++i) arguments.push_back(request[i].c_str());
  end_run(run_program(static_cast<int>(arguments.size()), arguments.data()));
}

/// Answers each request with the wait status of its run, until the test program closes its end. What a run
/// would load for its first picture is loaded once, before the first of them.
[[noreturn]] void serve(int connection) {
  std::string bytes(kLongestRequest, '\0');
  for (;;) {
    const ssize_t length = recv(connection, bytes.data(), bytes.size(), 0);
    if (length <= 0) _exit(0);
    picture_codecs();
    const pid_t child = fork();
    if (child == 0) run_here(unpacked(bytes.substr(0, static_cast<std::size_t>(length))));
    int status = -1;
    waitpid(child, &status, 0);
    send(connection, &status, sizeof status, 0);
  }
}

/// Forks the program for each run. It is itself forked before the first test: a process forked later might
/// miss threads that OpenMP counts on.
class ProgramServer : public testing::Environment {
 public:
  void SetUp() override {
    int ends[2];
    ASSERT_EQ(socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends), 0);
    std::fflush(nullptr);  // or each run prints what is still in the buffers
    if (fork() == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      close(ends[0]);
      serve(ends[1]);
    }
    close(ends[1]);
    connection_ = ends[0];
  }

  /// The wait status of the run.
  int run(const Request& request) const {
    const std::string bytes = packed(request);
    int status = -1;
    if (bytes.size() > kLongestRequest || send(connection_, bytes.data(), bytes.size(), 0) < 0 ||
        recv(connection_, &status, sizeof status, 0) != sizeof status)
      ADD_FAILURE() << "the program could not be run";
    return status;
  }

 private:
  int connection_ = -1;
};

const auto* const server = dynamic_cast<ProgramServer*>(testing::AddGlobalTestEnvironment(new ProgramServer));

/// The words of a command line as a shell splits them; nothing where it holds more than words.
std::optional<std::vector<std::string>> split_words(const std::string& line) {
  wordexp_t words{};
  if (wordexp(line.c_str(), &words, WRDE_NOCMD) != 0) return std::nullopt;
  std::vector<std::string> split(words.we_wordv, words.we_wordv + words.we_wordc);
  wordfree(&words);
  return split;
}

/// start(out, err): runs something whose output goes to these files, and returns its wait status.
template <class Start>
ProgramRun keep_output(Start start) {
  const auto folder = fresh_folder("run");
  const std::string out = folder / "out", err = folder / "err";
  const int status = start(out, err);
  ProgramRun run{WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text_file(out), read_text_file(err)};
  std::filesystem::remove_all(folder);
  return run;
}

/// The real program through the shell.
pid_t start_program(const std::string& command) {
  const pid_t child = fork();
  if (child == 0) {
    const std::string line = "exec '" ESPALIER_PROGRAM "' " + command + " >/dev/null 2>&1";
    execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
    _exit(127);
  }
  return child;
}

/// The wait status of a child after this signal.
int signalled(pid_t child, int signal) {
  kill(child, signal);
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

}  // namespace

ProgramRun run_shell(const std::string& command) {
  return keep_output([&](const std::string& out, const std::string& err) {
    return std::system(("{ " + command + "\n} </dev/null >'" + out + "' 2>'" + err + "'").c_str());
  });
}

ProgramRun run_espalier(const std::string& arguments) {
  const auto words = split_words(arguments);
  if (!words) return run_shell("'" ESPALIER_PROGRAM "' " + arguments);
  return keep_output([&](const std::string& out, const std::string& err) {
    Request request = {out, err};
    request.insert(request.end(), words->begin(), words->end());
    return server->run(request);
  });
}

int run_and_signal(const std::string& command, int delay_ms, int signal) {
  const pid_t child = start_program(command);
  usleep(static_cast<useconds_t>(delay_ms) * 1000);
  return signalled(child, signal);
}

int run_and_interrupt(const std::string& command, const std::filesystem::path& begun, int delay_ms,
                      int signal) {
  constexpr int kPatience_ms = 60'000;
  const pid_t child = start_program(command);
  for (int waited = 0; waited < kPatience_ms && !std::filesystem::exists(begun); waited += 10) usleep(10'000);
  usleep(static_cast<useconds_t>(delay_ms) * 1000);
  return signalled(child, signal);
}

void expect_one_clear_error(const ProgramRun& run) {
  EXPECT_EQ(run.exit_code, 2) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
}

}  // namespace espalier
