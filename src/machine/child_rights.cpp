#include <fcntl.h>
#include <sched.h>
#include <seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <utility>

#include <espalier/machine/child_rights.h>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define ESPALIER_HAS_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define ESPALIER_HAS_SANITIZER 1
#endif
#endif

namespace espalier {

namespace {

constexpr rlim_t kMostFiles = 64;

/// Its address space, in bytes; 0 where that is not known.
std::size_t address_space_bytes() {
  std::FILE* file = std::fopen("/proc/self/statm", "re");
  if (!file) return 0;
  std::size_t pages = 0;
  const bool is_read = std::fscanf(file, "%zu", &pages) == 1;
  std::fclose(file);
  return is_read ? pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) : 0;
}

/// Never above what holds already.
void limit(int resource, rlim_t most) {
  rlimit now{};
  if (getrlimit(static_cast<__rlimit_resource>(resource), &now) != 0) return;
  now.rlim_max = std::min(now.rlim_max, most);
  now.rlim_cur = std::min(now.rlim_cur, now.rlim_max);
  setrlimit(static_cast<__rlimit_resource>(resource), &now);
}

/// Calls that need no look at what they are asked.
constexpr int kAllowed[] = {
    // memory
    SCMP_SYS(brk), SCMP_SYS(mmap), SCMP_SYS(mmap2), SCMP_SYS(munmap), SCMP_SYS(mremap), SCMP_SYS(mprotect),
    SCMP_SYS(madvise), SCMP_SYS(membarrier),
    // open files; without their names, no new one can be written
    SCMP_SYS(read), SCMP_SYS(readv), SCMP_SYS(pread64), SCMP_SYS(preadv), SCMP_SYS(write), SCMP_SYS(writev),
    SCMP_SYS(lseek), SCMP_SYS(_llseek), SCMP_SYS(close), SCMP_SYS(fstat), SCMP_SYS(fstat64), SCMP_SYS(fcntl),
    SCMP_SYS(fcntl64), SCMP_SYS(fadvise64), SCMP_SYS(getdents64),
    // what there is
    SCMP_SYS(stat), SCMP_SYS(stat64), SCMP_SYS(lstat), SCMP_SYS(lstat64), SCMP_SYS(newfstatat),
    SCMP_SYS(fstatat64), SCMP_SYS(statx), SCMP_SYS(access), SCMP_SYS(faccessat), SCMP_SYS(faccessat2),
    SCMP_SYS(readlink), SCMP_SYS(readlinkat), SCMP_SYS(getcwd), SCMP_SYS(uname), SCMP_SYS(sysinfo),
    SCMP_SYS(getrandom),
    // threads of its own, and time
    SCMP_SYS(futex), SCMP_SYS(futex_time64), SCMP_SYS(set_robust_list), SCMP_SYS(rseq), SCMP_SYS(sched_yield),
    SCMP_SYS(sched_getaffinity), SCMP_SYS(getpid), SCMP_SYS(gettid), SCMP_SYS(clock_gettime),
    SCMP_SYS(clock_gettime64), SCMP_SYS(clock_nanosleep), SCMP_SYS(clock_nanosleep_time64),
    SCMP_SYS(nanosleep), SCMP_SYS(gettimeofday), SCMP_SYS(time), SCMP_SYS(getrlimit), SCMP_SYS(ugetrlimit),
    SCMP_SYS(getrusage),
    // its own signals, and its end
    SCMP_SYS(rt_sigaction), SCMP_SYS(rt_sigprocmask), SCMP_SYS(rt_sigreturn), SCMP_SYS(sigaltstack),
    SCMP_SYS(restart_syscall), SCMP_SYS(exit), SCMP_SYS(exit_group)};

scmp_arg_cmp masked(unsigned argument, scmp_datum_t mask, scmp_datum_t value) {
  return SCMP_CMP(argument, SCMP_CMP_MASKED_EQ, mask, value);
}

/// Calls that are allowed for one of their uses.
void allow_some_uses(scmp_filter_ctx filter) {
  const auto allow = [filter](int call, scmp_arg_cmp use) {
    seccomp_rule_add(filter, SCMP_ACT_ALLOW, call, 1, use);
  };
  constexpr scmp_datum_t kWriting = O_ACCMODE | O_CREAT | O_TRUNC;
  allow(SCMP_SYS(open), masked(1, kWriting, O_RDONLY));
  allow(SCMP_SYS(openat), masked(2, kWriting, O_RDONLY));
  allow(SCMP_SYS(clone), masked(0, CLONE_THREAD, CLONE_THREAD));
  allow(SCMP_SYS(prctl), SCMP_CMP(0, SCMP_CMP_EQ, PR_SET_NAME));
  allow(SCMP_SYS(prlimit64), SCMP_CMP(2, SCMP_CMP_EQ, 0));                                 // asks, sets none
  allow(SCMP_SYS(tgkill), SCMP_CMP(0, SCMP_CMP_EQ, static_cast<scmp_datum_t>(getpid())));  // abort
  // Its flags lie in memory, which no filter sees; the C library then takes clone.
  seccomp_rule_add(filter, SCMP_ACT_ERRNO(ENOSYS), SCMP_SYS(clone3), 0);
}

/// All other calls fail, as they do where there is no right to them: libraries ask for more than they need.
void filter_calls() {
  scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ERRNO(EPERM));
  if (!filter) return;
  for (const int call : kAllowed) seccomp_rule_add(filter, SCMP_ACT_ALLOW, call, 0);
  allow_some_uses(filter);
  if (has_sanitizer())
    seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(pipe2), 0);  // it tries addresses with one
  seccomp_load(filter);
  seccomp_release(filter);
}

}  // namespace

bool has_sanitizer() {
#ifdef ESPALIER_HAS_SANITIZER
  return true;
#else
  return false;
#endif
}

void close_other_files(int kept, int also_kept) {
  if (const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC); nowhere >= 0)
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, stream);
  const auto [low, high] = std::minmax(kept, also_kept);
  const auto close_range = [](unsigned first, unsigned last) {
    if (first > last || syscall(SYS_close_range, first, last, 0) == 0) return;
    const auto most = static_cast<unsigned>(std::min<long>(sysconf(_SC_OPEN_MAX), 65'536));
    for (unsigned file = first; file <= last && file < most; ++file) close(static_cast<int>(file));
  };
  close_range(STDERR_FILENO + 1, static_cast<unsigned>(low) - 1);
  close_range(static_cast<unsigned>(low) + 1, static_cast<unsigned>(high) - 1);
  close_range(static_cast<unsigned>(high) + 1, ~0u);
}

void give_up_rights(double cpu_s, std::size_t memory_bytes) {
  limit(RLIMIT_CPU, static_cast<rlim_t>(std::ceil(cpu_s)) + 1);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, 0);
  limit(RLIMIT_NOFILE, kMostFiles);
  if (const std::size_t bytes = has_sanitizer() ? 0 : address_space_bytes(); bytes > 0)
    limit(RLIMIT_AS, bytes + memory_bytes);
  prctl(PR_SET_DUMPABLE, 0);
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  filter_calls();
}

}  // namespace espalier
