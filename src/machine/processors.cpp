#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <future>
#include <iterator>
#include <limits>
#include <sstream>
#include <string_view>
#include <thread>
#include <vector>

#include <espalier/machine/processors.h>

namespace espalier {

namespace fs = std::filesystem;

namespace {

constexpr int kNoLimit = std::numeric_limits<int>::max();

int whole_processors(double quota_us, double period_us) {
  if (!(quota_us > 0 && period_us > 0)) return kNoLimit;
  return std::max(1, static_cast<int>(std::min(std::floor(quota_us / period_us), 1e6)));
}

/// "max 100000" or "150000 100000".
int quota_of_version_2(const fs::path& group) {
  double quota_us = 0, period_us = 0;
  std::ifstream file(group / "cpu.max");
  return file >> quota_us >> period_us ? whole_processors(quota_us, period_us) : kNoLimit;
}

/// The quota is -1 where there is none.
int quota_of_version_1(const fs::path& group) {
  double quota_us = 0, period_us = 0;
  std::ifstream quota(group / "cpu.cfs_quota_us"), period(group / "cpu.cfs_period_us");
  return quota >> quota_us && period >> period_us ? whole_processors(quota_us, period_us) : kNoLimit;
}

/// Of the group and of those above it; within a container its own is often the root.
template <typename Quota>
int least_quota(const fs::path& root, const fs::path& group, Quota quota) {
  int least = quota(root);
  fs::path path = root;
  for (const fs::path& part : group.relative_path()) least = std::min(least, quota(path /= part));
  return least;
}

std::string text_of(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

int determined_processors() {
  int count = runnable_processors();
  count = std::min(count, quota_of_group("/sys/fs/cgroup", text_of("/proc/self/cgroup")));
  count = std::min(count, limit_from(std::getenv("SLURM_CPUS_PER_TASK")));
  return startable_threads(std::max(count, 1));
}

}  // namespace

int quota_of_group(const fs::path& root, const std::string& membership) {
  int least = kNoLimit;
  std::istringstream lines(membership);
  for (std::string line; std::getline(lines, line);) {  // NUMBER:CONTROLLERS:GROUP
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = line.substr(first, second - first) + ',';
    const fs::path group = line.substr(second + 1);
    if (controllers == ":,") least = std::min(least, least_quota(root, group, quota_of_version_2));
    if (controllers.find(",cpu,") != std::string::npos || controllers.starts_with(":cpu,"))
      for (const char* mounted : {"cpu", "cpu,cpuacct"})
        least = std::min(least, least_quota(root / mounted, group, quota_of_version_1));
  }
  return least;
}

int limit_from(const char* text) {
  if (!text) return kNoLimit;
  const std::string_view word(text);
  int number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc() && end == word.data() + word.size() && number > 0 ? number : kNoLimit;
}

int startable_threads(int wanted) {
  std::promise<void> enough;
  const std::shared_future<void> wait = enough.get_future().share();
  std::vector<std::jthread> threads;
  try {
    while (static_cast<int>(threads.size()) + 1 < wanted) threads.emplace_back([wait] { wait.wait(); });
  } catch (const std::exception&) {  // a limit on processes or memory: what there is must do
  }
  enough.set_value();
  return static_cast<int>(threads.size()) + 1;
}

int runnable_processors() {
  cpu_set_t mask;
  if (sched_getaffinity(0, sizeof mask, &mask) == 0) return std::max(1, CPU_COUNT(&mask));
  return std::max(1, static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN)));  // more than the mask has bits
}

int processors() {
  static const int count = determined_processors();
  return count;
}

}  // namespace espalier
