// Whatever work does in a child, its parent gets the bytes or one line; and the child cannot do much.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <thread>
#include <vector>

#include <espalier/core/error.h>
#include <espalier/core/files.h>
#include <espalier/machine/child.h>
#include <espalier/machine/child_rights.h>

#include "support/temporary_folders.h"

namespace espalier {
namespace {

using testing::HasSubstr;
using Work = std::function<void(const SendBytes&)>;

/// The number that the work sends.
int answer_of(const Work& work, const ChildLimits& limits = {}) {
  Child child("a.png", limits, work);
  int answer = 0;
  child.read(&answer, sizeof answer);
  child.finish();
  return answer;
}

Work answers(const std::function<int()>& question) {
  return [question](const SendBytes& send) {
    const int answer = question();
    send(&answer, sizeof answer);
  };
}

std::string message_of(const Work& work, const ChildLimits& limits = {}) {
  try {
    answer_of(work, limits);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

/// What the call leaves in errno in a child; 0 where it succeeds.
int error_in_child(const std::function<long()>& call) {
  return answer_of(answers([call] { return call() < 0 ? errno : 0; }));
}

void sleep_long(const SendBytes&) { std::this_thread::sleep_for(std::chrono::hours(1)); }

bool has_children() { return waitpid(-1, nullptr, WNOHANG) >= 0 || errno != ECHILD; }

TEST(Child, HandsBackWhatTheWorkSends) {
  std::vector<int> numbers(3'000'000);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<int>(i * 2654435761u);
  Child child("a.png", {},
              [&](const SendBytes& send) { send(numbers.data(), numbers.size() * sizeof(int)); });
  std::vector<int> received(numbers.size());
  child.read(received.data(), received.size() * sizeof(int));
  child.finish();
  EXPECT_EQ(received, numbers);
}

TEST(Child, ErrorsOfTheWorkAreThoseOfItsParent) {
  EXPECT_EQ(message_of([](const SendBytes&) { throw_input_error("b.png: is cut off"); }),
            "b.png: is cut off");
  EXPECT_THROW(answer_of([](const SendBytes&) { throw InternalError("broken"); }), InternalError);
  EXPECT_EQ(message_of([](const SendBytes&) { throw std::out_of_range("at"); }),
            "a.png: its reader failed: at");
  EXPECT_THAT(message_of([](const SendBytes&) { throw std::bad_alloc(); }), HasSubstr("needs more memory"));
}

TEST(Child, ErrorsAfterTheAnswerAreNotLost) {
  Child child("a.png", {}, [](const SendBytes& send) {
    send("12", 2);
    throw_input_error("late");
  });
  char answer[2];
  child.read(answer, 2);
  EXPECT_THROW(child.finish(), InputError);
}

TEST(Child, ACrashIsOneLine) {
  EXPECT_EQ(message_of([](const SendBytes&) { std::abort(); }), "a.png: its reader crashed (signal 6)");
  EXPECT_EQ(message_of([](const SendBytes&) { raise(SIGSEGV); }), "a.png: its reader crashed (signal 11)");
  EXPECT_EQ(message_of([](const SendBytes&) { _exit(0); }), "a.png: its reader ended without an answer");
  EXPECT_EQ(message_of([](const SendBytes& send) { send("12", 2); }),
            "a.png: its reader sent less than was asked");
}

TEST(Child, WhatItSaysReachesNoTerminal) {
  testing::internal::CaptureStderr();
  message_of([](const SendBytes&) {
    (void)!write(STDERR_FILENO, "noise\n", 6);
    std::fputs("noise\n", stderr);
    std::abort();
  });
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Child, WorkWithoutEndIsEnded) {
  const Work spin = [](const SendBytes&) {
    for (std::atomic<int> i = 0;; ++i) {
    }
  };
  EXPECT_THAT(message_of(spin, {.cpu_s = 0.05}), HasSubstr("took longer than"));
  EXPECT_THAT(message_of(sleep_long, {.wall_s = 0.1}), HasSubstr("took longer than"));
}

TEST(Child, MemoryHasABound) {
  if (has_sanitizer()) GTEST_SKIP() << "sanitizers reserve all memory";
  const Work allocate = [](const SendBytes&) {
    for (std::vector<std::vector<char>> all;;) all.emplace_back(1 << 20, 'x');
  };
  EXPECT_THAT(message_of(allocate, {.cpu_s = 20, .memory_bytes = 64 << 20}), HasSubstr("needs more memory"));
  EXPECT_EQ(
      answer_of(answers([] { return std::vector<char>(32 << 20, 'x')[7] + 0; }), {.memory_bytes = 64 << 20}),
      'x');
}

TEST(Child, NoneIsLeftOver) {
  ASSERT_FALSE(has_children());
  message_of([](const SendBytes&) { std::abort(); });
  answer_of(answers([] { return 1; }));
  { const Child left("a.png", {}, sleep_long); }
  EXPECT_FALSE(has_children());
}

TEST(Child, ItsFilesAreItsOwn) {
  const auto folder = fresh_folder("child");
  const int file = open((folder / "log").c_str(), O_RDWR | O_CREAT, 0600);
  EXPECT_EQ(error_in_child([file] { return write(file, "x", 1); }), EBADF);
  EXPECT_EQ(read_file(folder / "log"), "");
  close(file);
}

TEST(Child, HasNoRights) {
  const auto folder = fresh_folder("rights");
  const std::string path = folder / "new", there = folder / "there";
  std::ofstream(there) << "x";
  if (prctl(PR_GET_SECCOMP) < 0) GTEST_SKIP() << "this kernel has no filter of system calls";
  EXPECT_EQ(error_in_child([] { return socket(AF_INET, SOCK_STREAM, 0); }), EPERM);
  EXPECT_EQ(error_in_child([&] { return open(path.c_str(), O_WRONLY | O_CREAT, 0600); }), EPERM);
  EXPECT_EQ(error_in_child([&] { return open(there.c_str(), O_RDWR); }), EPERM);
  EXPECT_EQ(error_in_child([&] { return open(there.c_str(), O_RDONLY | O_TRUNC); }), EPERM);
  EXPECT_EQ(error_in_child([&] { return open(there.c_str(), O_RDONLY); }), 0);
  EXPECT_EQ(error_in_child([&] { return unlink(there.c_str()); }), EPERM);
  EXPECT_EQ(error_in_child([&] { return chmod(there.c_str(), 0777); }), EPERM);
  EXPECT_EQ(error_in_child([] { return kill(getppid(), 0); }), EPERM);
  EXPECT_EQ(error_in_child([] { return fork(); }), EPERM);
  EXPECT_EQ(error_in_child([] { return execl("/bin/true", "true", nullptr); }), EPERM);
  EXPECT_EQ(read_file(there), "x");
}

TEST(Child, LimitsOfTheSystemHoldWithoutAFilter) {
  const auto most = [](int resource) {
    return answer_of(answers([resource] {
      rlimit limit{};
      getrlimit(static_cast<__rlimit_resource>(resource), &limit);
      return static_cast<int>(limit.rlim_max);
    }));
  };
  EXPECT_EQ(most(RLIMIT_CORE), 0);
  EXPECT_EQ(most(RLIMIT_FSIZE), 0);
  EXPECT_EQ(most(RLIMIT_NOFILE), 64);
  EXPECT_GE(most(RLIMIT_CPU), 1);
  EXPECT_LE(most(RLIMIT_CPU), 20);
}

TEST(Child, MayHaveThreadsOfItsOwn) {
  if (has_sanitizer()) GTEST_SKIP() << "ThreadSanitizer allows none after a fork";
  EXPECT_EQ(answer_of(answers([] {
              int answer = 0;
              std::thread([&answer] { answer = 7; }).join();
              return answer;
            })),
            7);
}

TEST(Child, ThreadsHaveChildrenAtATime) {
  std::vector<std::thread> threads;
  std::vector<int> answers_of(4);
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([i, &answers_of] {
      for (int j = 0; j < 20; ++j) answers_of[i] += answer_of(answers([i] { return i; }));
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(answers_of, (std::vector<int>{0, 20, 40, 60}));
}

/// A program's way with signals, for a test.
class ScopedSignal {
 public:
  ScopedSignal(int signal, void (*handler)(int)) : signal_(signal) {
    struct sigaction action {};
    action.sa_handler = handler;  // without SA_RESTART
    sigaction(signal, &action, &before_);
  }
  ~ScopedSignal() { sigaction(signal_, &before_, nullptr); }

 private:
  int signal_;
  struct sigaction before_ {};
};

TEST(Child, WorksInProgramsThatIgnoreTheirChildren) {
  const ScopedSignal ignored(SIGCHLD, SIG_IGN);
  EXPECT_EQ(answer_of(answers([] { return 5; })), 5);
  EXPECT_THAT(message_of([](const SendBytes&) { std::abort(); }), HasSubstr("ended without an answer"));
  EXPECT_THAT(message_of(sleep_long, {.wall_s = 0.1}), HasSubstr("took longer"));
}

TEST(Child, InterruptionsOfTheParentAreNone) {
  const ScopedSignal handled(SIGALRM, [](int) {});
  const itimerval often{.it_interval = {0, 2000}, .it_value = {0, 2000}}, never{};
  setitimer(ITIMER_REAL, &often, nullptr);
  EXPECT_EQ(answer_of(answers([] {
              std::this_thread::sleep_for(std::chrono::milliseconds(100));
              return 5;
            })),
            5);
  EXPECT_THAT(message_of([](const SendBytes&) { std::abort(); }), HasSubstr("crashed (signal 6)"));
  setitimer(ITIMER_REAL, &never, nullptr);
}

TEST(Child, SignalsOfTheTerminalAreItsParents) {
  EXPECT_EQ(answer_of(answers([] {
              raise(SIGINT), raise(SIGTERM), raise(SIGHUP);
              return 5;
            })),
            5);
}

TEST(Child, WorksWithClosedStreams) {
  const auto answer_without_streams = [] {
    close(STDIN_FILENO), close(STDOUT_FILENO);
    _exit(answer_of(answers([] { return 5; })));
  };
  EXPECT_EXIT(answer_without_streams(), testing::ExitedWithCode(5), "");
}

TEST(Child, WithoutProcessesIsOneLine) {
  if (has_sanitizer()) GTEST_SKIP() << "sanitizers have threads of their own";
  if (geteuid() != 0) GTEST_SKIP() << "needs a user without processes, which root can be";
  const auto answer_without_processes = [] {
    const rlimit none{.rlim_cur = 0, .rlim_max = 0};
    setrlimit(RLIMIT_NPROC, &none);
    if (setuid(61234) != 0) _exit(2);  // the limit does not hold for root
    _exit(message_of(answers([] { return 5; })).starts_with("a.png: no process can be started") ? 3 : 4);
  };
  EXPECT_EXIT(answer_without_processes(), testing::ExitedWithCode(3), "");
}

}  // namespace
}  // namespace espalier
