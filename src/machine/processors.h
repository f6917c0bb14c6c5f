// How many threads this process should work on: not all processors of a machine are its own.
#pragma once
#include <filesystem>
#include <string>

namespace espalier {

/// Those that it may run on (taskset), as far as its group's quota (containers: cgroups, version 2 or 1) and
/// Slurm (SLURM_CPUS_PER_TASK) leave them, and as far as threads can be started at all; at least 1. Asked
/// once.
int processors();

/// Those that it may run on (taskset).
int runnable_processors();

/// How many processors' time the quotas of a group and of all above it leave, rounded down, at least 1; a
/// large number where there is none. `root`: /sys/fs/cgroup; `membership`: the text of /proc/self/cgroup.
int quota_of_group(const std::filesystem::path& root, const std::string& membership);

/// The number in a variable like SLURM_CPUS_PER_TASK; a large one where it is none.
int limit_from(const char* text);

/// How many threads there can be at one time, with this one, up to `wanted`.
int startable_threads(int wanted);

}  // namespace espalier
