#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include <espalier/core/error.h>
#include <espalier/machine/directory_lock.h>

namespace espalier {

DirectoryLock::DirectoryLock(const std::filesystem::path& directory) {
  const std::filesystem::path path = directory / kLockName;
  file_ = open(path.c_str(), O_CREAT | O_RDWR | O_CLOEXEC | O_NOFOLLOW, 0644);
  if (file_ < 0)
    throw_input_error("{}: got '{}', expected a file that can be written", path.string(),
                      std::strerror(errno));
  if (flock(file_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  close(file_);
  throw_input_error("{}: got a directory that another process works in, expected to be alone",
                    directory.string());
}

DirectoryLock::~DirectoryLock() { close(file_); }

}  // namespace espalier
