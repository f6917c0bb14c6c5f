#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iterator>
#include <new>
#include <string_view>
#include <utility>

#include <espalier/core/error.h>
#include <espalier/machine/child.h>
#include <espalier/machine/child_rights.h>

namespace espalier {

namespace {

constexpr int kLookEveryMs = 20;                // at its limits
constexpr double kLongestEndS = 1;              // from the last byte to the status
constexpr std::size_t kMostWords = 2048;        // less than a pipe takes at once
constexpr double kSlownessWithSanitizers = 10;  // of the work

/// How the work ended: the first letter of the words.
enum Ending : char { kDone = 'd', kBadInput = 'i', kNoMemory = 'm', kBroken = 'b', kOtherError = 'x' };

double seconds_of(clockid_t clock) {
  timespec time{};
  if (clock_gettime(clock, &time) != 0) return 0;
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// 0 where it is not known.
double processor_seconds(pid_t process) {
  clockid_t clock{};
  return clock_getcpuclockid(process, &clock) == 0 ? seconds_of(clock) : 0;
}

/// Above the standard streams, which may be closed.
int above_streams(int file) {
  if (file > STDERR_FILENO) return file;
  const int above = fcntl(file, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  close(file);
  return above;
}

/// Of a pipe; closed where they are not released.
struct PipeEnds {
  int out = -1, in = -1;

  PipeEnds() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) == 0) out = above_streams(ends[0]), in = above_streams(ends[1]);
  }
  ~PipeEnds() {
    for (const int end : {out, in})
      if (end >= 0) close(end);
  }
  PipeEnds(const PipeEnds&) = delete;
  PipeEnds& operator=(const PipeEnds&) = delete;
};

/// No signal reaches this thread: a handler of the parent's must not run in the child.
class BlockedSignals {
 public:
  BlockedSignals() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~BlockedSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  BlockedSignals(const BlockedSignals&) = delete;
  BlockedSignals& operator=(const BlockedSignals&) = delete;

 private:
  sigset_t before_{};
};

// What the child does.

/// A parent that is gone needs no more bytes.
void write_or_leave(int descriptor, const void* bytes, std::size_t count) {
  for (const char* at = static_cast<const char*>(bytes); count > 0;) {
    const ssize_t written = write(descriptor, at, count);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) _exit(1);
    at += written;
    count -= static_cast<std::size_t>(written);
  }
}

void write_words(int descriptor, Ending ending, std::string_view words) {
  char text[kMostWords] = {ending};
  const std::size_t count = std::min(words.size(), sizeof text - 1);
  std::memcpy(text + 1, words.data(), count);
  write_or_leave(descriptor, text, 1 + count);
}

/// Crashes end the child; what stops the parent is the parent's to hear, which then ends its child.
void forget_signal_handlers() {
  for (int signal = 1; signal < NSIG; ++signal) ::signal(signal, SIG_DFL);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGUSR1, SIGUSR2, SIGALRM})
    ::signal(signal, SIG_IGN);
  sigset_t none;
  sigemptyset(&none);
  pthread_sigmask(SIG_SETMASK, &none, nullptr);
}

void do_work(const std::function<void(const SendBytes&)>& work, int data, int words) try {
  work([data](const void* bytes, std::size_t count) { write_or_leave(data, bytes, count); });
  write_words(words, kDone, "");
} catch (const InputError& error) {
  write_words(words, kBadInput, error.what());
} catch (const InternalError& error) {
  write_words(words, kBroken, error.what());
} catch (const std::bad_alloc&) {
  write_words(words, kNoMemory, "");
} catch (const std::exception& error) {
  write_words(words, kOtherError, error.what());
} catch (...) {
  write_words(words, kOtherError, "");
}

[[noreturn]] void be_child(const ChildLimits& limits, const std::function<void(const SendBytes&)>& work,
                           int data, int words, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);
  forget_signal_handlers();
  close_other_files(data, words);
  give_up_rights(limits.cpu_s, limits.memory_bytes);
  do_work(work, data, words);
  _exit(0);  // nothing of the parent's is flushed or destroyed
}

}  // namespace

bool forked_children_can_allocate() {
  if (!has_sanitizer()) return true;
  std::error_code none;
  const std::filesystem::directory_iterator threads("/proc/self/task", none);
  return std::distance(begin(threads), end(threads)) <= 1;
}

Child::Child(std::string subject, const ChildLimits& limits,
             const std::function<void(const SendBytes&)>& work)
    : subject_(std::move(subject)), limits_(limits), start_s_(seconds_of(CLOCK_MONOTONIC)) {
  if (has_sanitizer()) limits_.cpu_s *= kSlownessWithSanitizers, limits_.wall_s *= kSlownessWithSanitizers;
  PipeEnds data, words;
  if (data.out >= 0 && data.in >= 0 && words.out >= 0 && words.in >= 0) {
    const pid_t parent = getpid();
    const BlockedSignals blocked;
    process_ = fork();
    if (process_ == 0) be_child(limits_, work, data.in, words.in, parent);
  }
  if (process_ < 0)
    throw_input_error("{}: no process can be started for its reader: {}", subject_, std::strerror(errno));
  data_ = std::exchange(data.out, -1);
  words_ = std::exchange(words.out, -1);
  fcntl(data_, F_SETPIPE_SZ, 1 << 20);  // fewer turns; where it may not be, as many as there are
}

Child::~Child() {
  end();
  close(data_);
  close(words_);
}

/// Kills it where it still runs, and leaves no zombie. One that is gone by itself, where the program ignores
/// SIGCHLD or waited for it, is not signalled: its number may be another's.
void Child::end() {
  if (has_status_) return;
  pid_t ended = 0;
  while ((ended = waitpid(process_, &status_, WNOHANG)) < 0 && errno == EINTR) {
  }
  if (ended == 0) {
    kill(process_, SIGKILL);
    while (waitpid(process_, &status_, 0) < 0 && errno == EINTR) {
    }
  }
  has_status_ = true;
}

/// Until there is something to read, or the other end is closed.
void Child::wait_for(int descriptor) {
  pollfd waiting{.fd = descriptor, .events = POLLIN, .revents = 0};
  while (poll(&waiting, 1, kLookEveryMs) <= 0) {
    const bool is_too_long = seconds_of(CLOCK_MONOTONIC) - start_s_ > limits_.wall_s;
    if (!is_too_long && processor_seconds(process_) <= limits_.cpu_s) continue;
    end();
    throw_input_error("{}: its reader took longer than {:.3g} s", subject_,
                      is_too_long ? limits_.wall_s : limits_.cpu_s);
  }
}

void Child::read(void* bytes, std::size_t count) {
  for (char* at = static_cast<char*>(bytes); count > 0;) {
    wait_for(data_);
    const ssize_t got = ::read(data_, at, count);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) {
      check_ending(words());
      throw_input_error("{}: its reader sent less than was asked", subject_);
    }
    at += got;
    count -= static_cast<std::size_t>(got);
  }
}

/// What the work said of its end, in one piece; empty where it said nothing.
std::string Child::words() {
  char text[kMostWords];
  for (;;) {
    wait_for(words_);
    const ssize_t got = ::read(words_, text, sizeof text);
    if (got < 0 && errno == EINTR) continue;
    return {text, static_cast<std::size_t>(std::max<ssize_t>(0, got))};
  }
}

/// For the status of one that has closed its pipes.
void Child::await_end() {
  const double latest_s = seconds_of(CLOCK_MONOTONIC) + kLongestEndS;
  while (!has_status_ && seconds_of(CLOCK_MONOTONIC) < latest_s) {
    const pid_t ended = waitpid(process_, &status_, WNOHANG);
    if (ended < 0 && errno != EINTR) status_ = 0;
    has_status_ = ended == process_ || (ended < 0 && errno != EINTR);
    if (!has_status_) poll(nullptr, 0, 1);
  }
  end();
}

void Child::finish() { check_ending(words()); }

void Child::check_ending(const std::string& said) {
  const std::string rest = said.substr(std::min<std::size_t>(1, said.size()));
  if (said.empty()) throw_crash();
  if (said.front() == kBadInput) throw InputError(rest);
  if (said.front() == kBroken) throw InternalError(rest);
  if (said.front() == kNoMemory)
    throw_input_error("{}: its reader needs more memory than it may have", subject_);
  if (said.front() != kDone) throw_input_error("{}: its reader failed: {}", subject_, rest);
}

void Child::throw_crash() {
  await_end();
  if (!WIFSIGNALED(status_)) throw_input_error("{}: its reader ended without an answer", subject_);
  if (WTERMSIG(status_) == SIGXCPU)
    throw_input_error("{}: its reader took longer than {:.3g} s", subject_, limits_.cpu_s);
  throw_input_error("{}: its reader crashed (signal {})", subject_, WTERMSIG(status_));
}

}  // namespace espalier
