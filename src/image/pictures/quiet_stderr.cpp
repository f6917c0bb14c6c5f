#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <mutex>

#include <espalier/image/pictures/quiet_stderr.h>

namespace espalier {

namespace {

std::mutex mutex;
int lives = 0;
int saved_descriptor = -1;  ///< of stderr, while it is off; -1 where it could not be turned off

void turn_off() {
  std::fflush(stderr);
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  saved_descriptor = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 0);
  if (saved_descriptor >= 0) ::dup2(nowhere, STDERR_FILENO);
  ::close(nowhere);
}

void turn_on() {
  if (saved_descriptor < 0) return;
  std::fflush(stderr);
  ::dup2(saved_descriptor, STDERR_FILENO);
  ::close(saved_descriptor);
  saved_descriptor = -1;
}

}  // namespace

QuietStderr::QuietStderr() {
  const std::lock_guard guard(mutex);
  if (lives++ == 0) turn_off();
}

QuietStderr::~QuietStderr() {
  const std::lock_guard guard(mutex);
  if (--lives == 0) turn_on();
}

}  // namespace espalier
