#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cstdio>
#include <vector>

#include <espalier/core/data_path.h>
#include <espalier/core/error.h>
#include <espalier/experiments/analysis/draw_report.h>

extern char** environ;

namespace espalier {

namespace fs = std::filesystem;

namespace {

/// Debian's own Python, which has Debian's Matplotlib; another one on PATH may not.
fs::path find_python() {
  const fs::path debian = "/usr/bin/python3";
  return fs::exists(debian) ? debian : fs::path("python3");
}

/// The exit code, or -1 where the program could not be started.
int run_program_file(std::vector<std::string> arguments) {
  std::vector<char*> pointers;
  pointers.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  pid_t child = 0;
  if (posix_spawnp(&child, pointers[0], nullptr, nullptr, pointers.data(), environ) != 0) return -1;
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

}  // namespace

void draw_report(const fs::path& report_directory) {
  const fs::path script = data_path("experiments/report/report.py");
  const int code = run_program_file({find_python(), script, report_directory});
  if (code == -1 || code == 127)
    fmt::print(stderr,
               "espalier: no Python found: the report has its tables only; install python3-matplotlib\n");
  else if (code != 0)
    throw InternalError(
        fmt::format("{}: {} ended with exit code {}", report_directory.string(), script.string(), code));
}

}  // namespace espalier
