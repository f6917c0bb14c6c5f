// What the head of a PLY file claims: a file of a hundred bytes may announce a billion vertices, and readers
// believe it.
#pragma once
#include <string_view>

namespace espalier {

/// Throws InputError where a PLY file announces more elements than it has bytes. Other files pass.
void check_ply_counts(std::string_view bytes);

}  // namespace espalier
