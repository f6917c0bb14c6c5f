// What a child that reads files from strangers may do: use its memory and its processor, read files, and
// write into pipes that it has. Not: write files, reach the network, start programs, touch other processes.
#pragma once
#include <cstddef>

namespace espalier {

/// Whether this is built with a sanitizer, whose memory has no bounds.
bool has_sanitizer();

/// Closes all files of this process but these two; the standard streams lead nowhere.
void close_other_files(int kept, int also_kept);

/// Gives up rights for good: limits of the system (processor, memory beside what there is now, files of no
/// size, no core dumps), no new privileges, and a filter of system calls (seccomp). What a kernel does not
/// have is left out without a word: limits hold everywhere.
void give_up_rights(double cpu_s, std::size_t memory_bytes);

}  // namespace espalier
