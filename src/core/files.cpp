#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <random>
#include <system_error>

#include <espalier/core/error.h>
#include <espalier/core/files.h>

namespace espalier {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void throw_cannot_write(const fs::path& path, int error_number) {
  throw_input_error("{}: cannot be written: {}", path.string(), std::strerror(error_number));
}

/// Some file systems cannot: there is nothing more to be done then.
int sync(int descriptor) {
  if (::fsync(descriptor) == 0 || errno == EINVAL || errno == EROFS || errno == ENOTSUP) return 0;
  return -1;
}

/// Brings the names in a folder to the disk; returns errno. A folder that cannot be read was written all the
/// same.
int sync_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return 0;
  const int failed = sync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  return failed;
}

constexpr std::string_view kTemporaryBegin = ".espalier-", kTemporaryEnd = ".tmp";

/// In the same folder as `path`, so that the rename stays on one file system, and short whatever that is
/// called. By chance alone: process numbers are the same again in each container.
fs::path temporary_path(const fs::path& path) {
  thread_local std::random_device chance;
  return path.parent_path() / fmt::format("{}{:08x}{:08x}{}", kTemporaryBegin, std::uint32_t{chance()},
                                          std::uint32_t{chance()}, kTemporaryEnd);
}

/// A file that disappears again unless it was kept.
class TemporaryFile {
 public:
  TemporaryFile(const fs::path& beside, const fs::path& for_path) {
    do {
      path_ = temporary_path(beside);
      descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (descriptor_ < 0 && errno == EEXIST);
    if (descriptor_ < 0) throw_cannot_write(for_path, errno);
  }
  ~TemporaryFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!kept_) ::unlink(path_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  int descriptor() const { return descriptor_; }
  /// Brings the bytes to the disk, closes and renames; returns errno, 0 where all went well.
  int keep_as(const fs::path& target) {
    const int synced = sync(descriptor_), failed = synced == 0 ? 0 : errno;
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    if (failed != 0) return failed;
    if (closed != 0 || ::rename(path_.c_str(), target.c_str()) != 0) return errno;
    kept_ = true;
    return sync_folder(target.parent_path());
  }

 private:
  fs::path path_;
  int descriptor_ = -1;
  bool kept_ = false;
};

/// Returns errno, 0 where all bytes were taken.
int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

using WriteBytes = std::function<void(const TakeBytes& take)>;

/// Throws where a piece is not taken whole.
TakeBytes into(int descriptor, const fs::path& path) {
  return [descriptor, &path](std::string_view bytes) {
    if (const int failed = write_all(descriptor, bytes)) throw_cannot_write(path, failed);
  };
}

/// A device or a pipe cannot be replaced by a rename.
void write_in_place(const fs::path& path, const WriteBytes& write) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) throw_cannot_write(path, errno);
  try {
    write(into(descriptor, path));
  } catch (...) {
    ::close(descriptor);
    throw;
  }
  ::close(descriptor);
}

/// A regular file, open to be read. Opening a pipe does not wait for who writes into it.
class InputFile {
 public:
  explicit InputFile(const fs::path& path)
      : descriptor_(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {
    if (descriptor_ < 0 && (errno == ENOENT || errno == ENOTDIR))
      throw_input_error("{}: there is no such file", path.string());
    const int failed = descriptor_ < 0 || ::fstat(descriptor_, &status_) != 0 ? errno : 0;
    if (failed == 0 && S_ISREG(status_.st_mode)) return;
    if (descriptor_ >= 0) ::close(descriptor_);
    if (failed != 0) throw_input_error("{}: cannot be read: {}", path.string(), std::strerror(failed));
    throw_input_error("{}: is {}, expected a file", path.string(),
                      S_ISDIR(status_.st_mode) ? "a directory" : "a pipe or a device");
  }
  ~InputFile() { ::close(descriptor_); }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  int descriptor() const { return descriptor_; }
  const struct stat& status() const { return status_; }

 private:
  struct stat status_ {};
  int descriptor_;
};

constexpr std::size_t kSmallestPiece = 4096;

/// Returns 0 at the end.
std::size_t read_some(int descriptor, char* bytes, std::size_t count, const fs::path& path) {
  for (;;) {
    const ssize_t got = ::read(descriptor, bytes, count);
    if (got >= 0) return static_cast<std::size_t>(got);
    if (errno != EINTR) throw_input_error("{}: cannot be read to its end", path.string());
  }
}

[[noreturn]] void throw_too_large(const fs::path& path, std::uintmax_t most_bytes) {
  throw_input_error("{}: got more than {} bytes, expected a smaller file", path.string(), most_bytes);
}

}  // namespace

void write_file_atomically(const fs::path& path, std::string_view bytes) {
  write_file_atomically(path, [bytes](const TakeBytes& take) { take(bytes); });
}

void write_file_atomically(const fs::path& path, const WriteBytes& write) {
  std::error_code none;
  const fs::file_status status = fs::status(path, none);
  if (fs::is_directory(status)) throw_cannot_write(path, EISDIR);
  if (fs::exists(status) && !fs::is_regular_file(status)) return write_in_place(path, write);
  const fs::path target = fs::is_symlink(fs::symlink_status(path, none)) ? fs::weakly_canonical(path) : path;
  TemporaryFile file(target, path);
  write(into(file.descriptor(), path));
  if (const int failed = file.keep_as(target)) throw_cannot_write(path, failed);
}

void make_directory(const fs::path& directory) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error)
    throw_input_error("{}: got '{}', expected a directory that can be made", directory.string(),
                      error.message());
}

bool is_temporary_name(const fs::path& path) {
  const std::string name = path.filename().string();  // of earlier versions: ".run.toml.1-0.tmp"
  return name.starts_with('.') && name.find('-') != std::string::npos && name.ends_with(kTemporaryEnd);
}

void remove_temporary_files(const fs::path& directory) {
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(directory, none))
    if (is_temporary_name(entry.path()) && entry.symlink_status(none).type() == fs::file_type::regular)
      fs::remove(entry.path(), none);
}

std::string read_file(const fs::path& path, std::uintmax_t most_bytes) {
  const InputFile file(path);
  const auto claimed = static_cast<std::uintmax_t>(file.status().st_size);
  if (claimed > most_bytes) throw_too_large(path, most_bytes);
  std::string bytes;
  for (std::size_t count = 0;; count = bytes.size()) {  // files of /proc claim no bytes, and have some
    bytes.resize(count > claimed ? count + (count >> 1) + kSmallestPiece
                                 : std::max<std::size_t>(claimed + 1, kSmallestPiece));
    const std::size_t got = read_some(file.descriptor(), bytes.data() + count, bytes.size() - count, path);
    bytes.resize(count + got);
    if (got == 0) return bytes;
    if (bytes.size() > most_bytes) throw_too_large(path, most_bytes);
  }
}

std::string read_beginning(const fs::path& path, std::size_t most_bytes) {
  const InputFile file(path);
  std::string bytes(std::min(most_bytes, static_cast<std::size_t>(file.status().st_size)), '\0');
  std::size_t count = 0, got = 0;
  while ((got = read_some(file.descriptor(), bytes.data() + count, bytes.size() - count, path)) > 0)
    count += got;
  bytes.resize(count);
  return bytes;
}

}  // namespace espalier
