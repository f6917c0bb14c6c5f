#include "image/quiet_stderr.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>

namespace espalier {

QuietStderr::QuietStderr() {
  std::fflush(stderr);
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  saved_descriptor_ = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 0);
  if (saved_descriptor_ >= 0) ::dup2(nowhere, STDERR_FILENO);
  ::close(nowhere);
}

QuietStderr::~QuietStderr() {
  if (saved_descriptor_ < 0) return;
  std::fflush(stderr);
  ::dup2(saved_descriptor_, STDERR_FILENO);
  ::close(saved_descriptor_);
}

}  // namespace espalier
