#include <fmt/format.h>
#include <unistd.h>

#include <csignal>

#include <espalier/app/options/long_work.h>
#include <espalier/app/options/messages.h>

namespace espalier {

namespace {

using Clock = std::chrono::steady_clock;

volatile std::sig_atomic_t interrupted = 0;

void on_signal(int) { interrupted = 1; }

/// Calls that wait go on: nothing is lost that a signal arrives in the middle of.
void note(int signal, int flags = 0) {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART | flags;
  sigemptyset(&action.sa_mask);
  sigaction(signal, &action, nullptr);
}

bool is_ignored(int signal) {
  struct sigaction action = {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

void watch_for_interrupt() {
  std::signal(SIGXFSZ, SIG_IGN);
  note(SIGINT, SA_RESETHAND);
  for (const int signal : {SIGTERM, SIGUSR1, SIGXCPU})
    note(signal);  // they may come again until a limit kills
  if (!is_ignored(SIGHUP)) note(SIGHUP);
}

bool is_interrupted() { return interrupted != 0; }

ProgressLine::ProgressLine(bool quiet, double plain_pause_s)
    : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0), pause_s_(terminal_ ? 0.2 : plain_pause_s) {}

bool ProgressLine::is_due() const {
  if (quiet_) return false;
  return !shown_at_ || std::chrono::duration<double>(Clock::now() - *shown_at_).count() >= pause_s_;
}

void ProgressLine::print(const std::string& text) {
  shown_at_ = Clock::now();
  print_to_stderr(fmt::format("{}{}{}", terminal_ ? "\r\033[K" : "", text, terminal_ ? "" : "\n"));
}

void ProgressLine::end() const {
  if (shown_at_ && terminal_) print_to_stderr("\r\033[K");
}

}  // namespace espalier
