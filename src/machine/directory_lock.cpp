#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include <espalier/core/error.h>
#include <espalier/core/files.h>
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

bool holds_other_files(const std::filesystem::path& directory,
                       const std::function<bool(const std::filesystem::path& name)>& is_own,
                       std::error_code& error) {
  const bool has_begun = std::filesystem::exists(directory / kLockName, error);
  for (const auto& entry : std::filesystem::directory_iterator(directory, error)) {
    const std::filesystem::path name = entry.path().filename();
    if (name != kLockName && !is_temporary_name(name) && !(has_begun && is_own(name))) return true;
  }
  return false;
}

}  // namespace espalier
