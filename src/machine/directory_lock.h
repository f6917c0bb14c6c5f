// A directory that one process at a time works in.
#pragma once
#include <filesystem>
#include <functional>
#include <system_error>

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

/// Whether the directory has files that are none of: its lock, what killed programs left, and, where there is
/// a lock, so that one began here, those whose names are its own. What cannot be read is told by `error`.
bool holds_other_files(const std::filesystem::path& directory,
                       const std::function<bool(const std::filesystem::path& name)>& is_own,
                       std::error_code& error);

}  // namespace espalier
