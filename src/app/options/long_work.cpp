#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>

#include <espalier/app/options/long_work.h>

namespace espalier {

namespace {

using Clock = std::chrono::steady_clock;

volatile std::sig_atomic_t interrupted = 0;

void on_interrupt(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void watch_for_interrupt() {
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGINT, on_interrupt);
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
  fmt::print(stderr, "{}{}{}", terminal_ ? "\r\033[K" : "", text, terminal_ ? "" : "\n");
  std::fflush(stderr);
}

void ProgressLine::end() const {
  if (shown_at_ && terminal_) fmt::print(stderr, "\r\033[K");
}

}  // namespace espalier
