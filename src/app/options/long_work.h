// What commands that work for long share: signals that end them in good order, and a line of progress.
#pragma once
#include <chrono>
#include <optional>
#include <string>

namespace espalier {

/// From now on what asks a process to end is noted: Ctrl-C, the second of which kills; SIGTERM (docker stop,
/// Slurm, kill); SIGHUP, unless it was ignored before (nohup); SIGUSR1 and SIGXCPU (batch systems, before
/// their limit). Files that grow beyond a limit become errors to report instead of a death.
void watch_for_interrupt();
bool is_interrupted();

/// Progress on stderr: one line that is written over on a terminal, a plain line now and then elsewhere.
class ProgressLine {
 public:
  /// plain_pause_s: between two lines where there is no terminal.
  ProgressLine(bool quiet, double plain_pause_s);

  /// `text` is called where a line is due.
  template <typename Text>
  void show(Text text) {
    if (is_due()) print(text());
  }
  /// Clears the line of a terminal.
  void end() const;

 private:
  bool is_due() const;
  void print(const std::string& text);

  bool quiet_, terminal_;
  double pause_s_;
  std::optional<std::chrono::steady_clock::time_point> shown_at_;
};

}  // namespace espalier
