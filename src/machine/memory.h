// The memory of this machine.
#pragma once

namespace espalier {

/// In bytes: of this machine, or of the group of processes that may use less of it (cgroups, version 2);
/// infinite where neither is known.
double machine_memory_bytes();

}  // namespace espalier
