// A directory that one process at a time works in.
#pragma once
#include <filesystem>

namespace espalier {

/// Holds the directory for this process as long as it lives, by the file "lock" in it; the system lets go of
/// it when the process ends, however it ends.
class DirectoryLock {
 public:
  /// Throws InputError where another process holds it, or the file cannot be made. A file system without
  /// locks lets everybody in.
  explicit DirectoryLock(const std::filesystem::path& directory);
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

 private:
  int file_ = -1;
};

/// The name of that file.
inline constexpr const char* kLockName = "lock";

}  // namespace espalier
