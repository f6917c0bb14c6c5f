// A layer between a program and the C library (LD_PRELOAD) under which the machine fails at one call: the
// n-th of those that open, write, sync, rename, close, make or remove files below a folder. What the
// environment says:
//
//   FAILING_CALLS_BELOW=FOLDER   calls elsewhere are left alone
//   FAILING_CALLS_AT=N           from 1 on; without it, nothing fails
//   FAILING_CALLS_HOW=error      that call fails, as of a disk that is full or broken
//                     kill       the process ends before it
//                     torn       of a write its first half is made, then the process ends
//                     cut        power is lost before it: bytes and names that were not synced never were
//                     zeros      the same, where names had been kept and bytes were zeros, as some file
//                     systems do
//   FAILING_CALLS_COUNT=FILE     gets the number of calls, when the program ends
//
// After FAILING_CALLS_AT an "error" happens once: what the program does then must be right, too.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace {

template <class F>
F next(const char* name) {
  return reinterpret_cast<F>(dlsym(RTLD_NEXT, name));
}

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

struct Renamed {
  std::string from, to, old;  // old: a second name of what `to` was, empty if there was nothing
};

/// What has happened, and what of it would outlast a power cut.
struct Disk {
  std::recursive_mutex mutex;
  std::string below = environment("FAILING_CALLS_BELOW"), how = environment("FAILING_CALLS_HOW");
  long at = std::atol(environment("FAILING_CALLS_AT").c_str()), calls = 0;
  bool busy = false;                    // with calls of its own
  std::map<std::string, off_t> synced;  // bytes of files that were written, by their name
  std::vector<Renamed> renamed;         // whose folder was not synced since
  std::vector<std::string> made;        // names of files, likewise

  ~Disk() {
    busy = true;
    const std::string file = environment("FAILING_CALLS_COUNT");
    if (file.empty()) return;
    if (std::FILE* stream = std::fopen(file.c_str(), "w")) {
      std::fprintf(stream, "%ld\n", calls);
      std::fclose(stream);
    }
  }
};

Disk& disk() {
  static Disk the_disk;
  return the_disk;
}

std::string absolute(const char* path) {
  if (path[0] == '/') return path;
  char folder[PATH_MAX];
  return getcwd(folder, sizeof folder) ? std::string(folder) + "/" + path : path;
}

std::string name_of(int descriptor) {
  char name[PATH_MAX];
  const std::string link = "/proc/self/fd/" + std::to_string(descriptor);
  const ssize_t size = readlink(link.c_str(), name, sizeof name);
  return size > 0 ? std::string(name, static_cast<std::size_t>(size)) : "";
}

bool is_below(const std::string& path) {
  return !disk().below.empty() && (path == disk().below || path.starts_with(disk().below + "/"));
}

std::string folder_of(const std::string& path) { return path.substr(0, path.rfind('/')); }

off_t size_of(const std::string& path) {
  struct stat status;
  return stat(path.c_str(), &status) == 0 ? status.st_size : -1;
}

/// Bytes that were never synced: gone, or zeros.
void lose_bytes() {
  for (const auto& [path, bytes] : disk().synced) {
    const off_t size = size_of(path);
    if (size <= bytes) continue;
    (void)!truncate(path.c_str(), bytes);
    if (disk().how == "zeros") (void)!truncate(path.c_str(), size);
  }
}

void lose_names() {
  auto& renamed = disk().renamed;
  for (auto one = renamed.rbegin(); one != renamed.rend(); ++one) {
    std::rename(one->to.c_str(), one->from.c_str());
    if (!one->old.empty()) std::rename(one->old.c_str(), one->to.c_str());
  }
  for (const std::string& name : disk().made) unlink(name.c_str());
}

[[noreturn]] void end_process() {
  kill(getpid(), SIGKILL);
  for (;;) pause();
}

[[noreturn]] void cut_power() {
  disk().busy = true;
  lose_bytes();
  if (disk().how == "cut") lose_names();
  end_process();
}

/// Counts the call; true where it is to fail with an error.
bool fails() {
  if (++disk().calls != disk().at) return false;
  if (disk().how == "error") return true;
  if (disk().how == "cut" || disk().how == "zeros") cut_power();
  if (disk().how == "kill") end_process();
  return false;  // torn: the call itself looks
}

/// Whether the call is one of those counted.
struct Watch {
  std::lock_guard<std::recursive_mutex> lock{disk().mutex};
  bool counted;
  explicit Watch(const std::string& path) : counted(!disk().busy && is_below(path)) {}
};

int open_any(const char* name, const char* path, int flags, mode_t mode) {
  const auto real = next<int (*)(const char*, int, mode_t)>(name);
  const std::string whole = absolute(path);
  const Watch watch(whole);
  if (!watch.counted) return real(path, flags, mode);
  if (fails()) {
    errno = (flags & O_CREAT) != 0 ? ENOSPC : EMFILE;
    return -1;
  }
  const bool is_new = (flags & O_CREAT) != 0 && size_of(whole) < 0;
  const int descriptor = real(path, flags, mode);
  if (descriptor >= 0 && is_new) {
    disk().made.push_back(whole);
    disk().synced[whole] = 0;
  } else if (descriptor >= 0 && (flags & O_ACCMODE) != O_RDONLY && !disk().synced.contains(whole)) {
    disk().synced[whole] = std::max<off_t>(size_of(whole), 0);
  }
  return descriptor;
}

int sync_any(const char* name, int descriptor) {
  const std::string path = name_of(descriptor);
  const Watch watch(path);
  if (watch.counted) {
    if (fails()) {
      errno = EIO;
      return -1;
    }
    if (disk().synced.contains(path)) disk().synced[path] = size_of(path);
    std::erase_if(disk().renamed, [&](const Renamed& one) {
      if (folder_of(one.to) != path) return false;
      if (!one.old.empty()) unlink(one.old.c_str());
      return true;
    });
    std::erase_if(disk().made, [&](const std::string& made) { return folder_of(made) == path; });
  }
  return next<int (*)(int)>(name)(descriptor);
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  return open_any("open", path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  return open_any("open64", path, flags, mode);
}

ssize_t write(int descriptor, const void* bytes, size_t size) {
  const auto real = next<ssize_t (*)(int, const void*, size_t)>("write");
  const Watch watch(name_of(descriptor));
  if (!watch.counted) return real(descriptor, bytes, size);
  if (fails()) {
    errno = ENOSPC;
    return -1;
  }
  if (disk().calls == disk().at && disk().how == "torn") {
    real(descriptor, bytes, size / 2);
    end_process();
  }
  return real(descriptor, bytes, size);
}

int fsync(int descriptor) { return sync_any("fsync", descriptor); }
int fdatasync(int descriptor) { return sync_any("fdatasync", descriptor); }

int close(int descriptor) {
  const Watch watch(name_of(descriptor));
  const bool failed = watch.counted && fails();
  const int result = next<int (*)(int)>("close")(descriptor);  // closed, whatever it says
  if (!failed) return result;
  errno = EIO;
  return -1;
}

int rename(const char* from, const char* to) noexcept {
  const auto real = next<int (*)(const char*, const char*)>("rename");
  const Watch watch(absolute(to));
  if (!watch.counted) return real(from, to);
  if (fails()) {
    errno = EIO;
    return -1;
  }
  Renamed one{absolute(from), absolute(to), ""};
  if (size_of(one.to) >= 0) {
    one.old = disk().below + ".old-" + std::to_string(disk().calls);
    if (link(one.to.c_str(), one.old.c_str()) != 0) one.old.clear();
  }
  const int result = real(from, to);
  if (result != 0) return result;
  if (const auto found = disk().synced.find(one.from); found != disk().synced.end()) {
    disk().synced[one.to] = found->second;
    disk().synced.erase(one.from);
  }
  // The name of the temporary file is the rename's from now on.
  const bool was_made = std::erase(disk().made, one.from) > 0;
  if (was_made && one.old.empty()) disk().made.push_back(one.to);
  if (!was_made || !one.old.empty()) disk().renamed.push_back(one);
  return 0;
}

int unlink(const char* path) noexcept {
  const std::string whole = absolute(path);
  const Watch watch(whole);
  if (watch.counted && fails()) {
    errno = EIO;
    return -1;
  }
  if (watch.counted) {
    disk().synced.erase(whole);
    std::erase(disk().made, whole);
  }
  return next<int (*)(const char*)>("unlink")(path);
}

int mkdir(const char* path, mode_t mode) noexcept {
  const Watch watch(absolute(path));
  if (watch.counted && fails()) {
    errno = ENOSPC;
    return -1;
  }
  return next<int (*)(const char*, mode_t)>("mkdir")(path, mode);
}

}  // extern "C"
