// What the head of a PLY file claims: a file of a hundred bytes may announce a billion vertices, and readers
// believe it.
#pragma once
#include <cstdint>
#include <string_view>

namespace espalier {

/// Throws InputError where `begin`, the first bytes of a PLY file of `file_bytes`, announces more elements
/// than the file has bytes. Other files pass.
void check_ply_counts(std::string_view begin, std::uintmax_t file_bytes);

}  // namespace espalier
