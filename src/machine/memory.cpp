#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>

#include <espalier/machine/memory.h>

namespace espalier {

double machine_memory_bytes() {
  const long pages = sysconf(_SC_PHYS_PAGES), page_bytes = sysconf(_SC_PAGESIZE);
  double bytes = pages > 0 && page_bytes > 0 ? static_cast<double>(pages) * static_cast<double>(page_bytes)
                                             : std::numeric_limits<double>::infinity();
  double group_bytes = 0;  // the file says "max" where there is no limit
  if (std::ifstream("/sys/fs/cgroup/memory.max") >> group_bytes) bytes = std::min(bytes, group_bytes);
  return bytes;
}

}  // namespace espalier
