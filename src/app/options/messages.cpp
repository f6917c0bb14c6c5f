#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include <espalier/app/options/messages.h>
#include <espalier/core/text/one_line.h>

namespace espalier {

namespace {

constexpr std::size_t kLongestError = 300, kLongestWarning = 600;  ///< with the line's end

}  // namespace

void print_to_stderr(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(STDERR_FILENO, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;  // nobody is there to be told
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void print_message(std::string_view text) {
  print_to_stderr(one_line(fmt::format("espalier: {}", text), kLongestError - 1) + "\n");
}

void print_warning(std::string_view text) {
  print_to_stderr(one_line(fmt::format("espalier: warning: {}", text), kLongestWarning - 1) + "\n");
}

void open_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0 && errno == EBADF)
      (void)::open("/dev/null",
                   stream == STDIN_FILENO ? O_RDONLY : O_WRONLY);  // takes the lowest that is free
}

bool flush_output() {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return true;
  print_message(fmt::format("stdout: got '{}', expected a stream that can be written", std::strerror(errno)));
  return false;
}

}  // namespace espalier
