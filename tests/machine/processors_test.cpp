// How many threads a process should work on, from what groups of processes and batch systems say.
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include <espalier/machine/processors.h>

#include "support/temporary_folders.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define ESPALIER_IS_SANITIZED true
#endif
#endif
#ifndef ESPALIER_IS_SANITIZED
#define ESPALIER_IS_SANITIZED false
#endif
constexpr bool kIsSanitized = ESPALIER_IS_SANITIZED;

void write_quota(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text << "\n";
}

TEST(Quota, IsTheLeastOfAGroupAndThoseAboveIt) {
  const fs::path root = fresh_folder("cgroup");
  EXPECT_GT(quota_of_group(root, "0::/a/b\n"), 1'000'000) << "there is none";
  write_quota(root / "a/b/cpu.max", "max 100000");
  EXPECT_GT(quota_of_group(root, "0::/a/b\n"), 1'000'000);
  write_quota(root / "a/cpu.max", "350000 100000");
  EXPECT_EQ(quota_of_group(root, "0::/a/b\n"), 3);
  EXPECT_GT(quota_of_group(root, "0::/other\n"), 1'000'000);
  write_quota(root / "a/b/cpu.max", "50000 100000");
  EXPECT_EQ(quota_of_group(root, "0::/a/b\n"), 1) << "half a processor is one thread";
  write_quota(root / "cpu.max", "20000 10000");
  EXPECT_EQ(quota_of_group(root, "0::/other\n"), 2) << "a container's own group is the root";
}

TEST(Quota, OfVersion1IsThatOfTheControllerOfTime) {
  const fs::path root = fresh_folder("cgroup");
  write_quota(root / "cpu,cpuacct/job/cpu.cfs_quota_us", "400000");
  write_quota(root / "cpu,cpuacct/job/cpu.cfs_period_us", "100000");
  EXPECT_EQ(quota_of_group(root, "5:memory:/\n4:cpu,cpuacct:/job\n"), 4);
  EXPECT_GT(quota_of_group(root, "4:cpuset:/job\n"), 1'000'000) << "that is another controller";
  write_quota(root / "cpu,cpuacct/job/cpu.cfs_quota_us", "-1");
  EXPECT_GT(quota_of_group(root, "4:cpu,cpuacct:/job\n"), 1'000'000);
}

TEST(Limit, OfAVariableIsAWholeNumberAbove0) {
  EXPECT_EQ(limit_from("4"), 4);
  for (const char* text : {static_cast<const char*>(nullptr), "", "four", "4x", "0", "-1", "99999999999999"})
    EXPECT_GT(limit_from(text), 1'000'000) << (text ? text : "none");
}

/// The exit code of a process of its own that ends with what `body` returns.
template <typename Body>
int exit_code_of_fork(Body body) {
  const pid_t child = fork();
  if (child == 0) _exit(body());
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(Processors, AreThoseThatTheProcessMayRunOn) {
  EXPECT_GE(processors(), 1);
  EXPECT_LE(processors(), runnable_processors());
  EXPECT_EQ(exit_code_of_fork([] {
              cpu_set_t one;
              CPU_ZERO(&one);
              CPU_SET(0, &one);
              return sched_setaffinity(0, sizeof one, &one) == 0 ? runnable_processors() : 99;
            }),
            1);
}

TEST(StartableThreads, AreFewerWhereTheSystemRefuses) {
  EXPECT_EQ(startable_threads(1), 1);
  EXPECT_EQ(startable_threads(5), 5);
  if (kIsSanitized) return;  // a sanitizer needs all addresses there are
  EXPECT_EQ(exit_code_of_fork([] {
              const rlimit space{300u << 20, 300u << 20};  // of addresses: a thread's stack takes 8 MB
              setrlimit(RLIMIT_AS, &space);
              const int threads = startable_threads(200);
              return threads >= 1 && threads < 200 ? 0 : 1;
            }),
            0);
}

}  // namespace
}  // namespace espalier
