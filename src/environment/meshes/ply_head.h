// What the head of a PLY file says: a file of a hundred bytes may announce a billion vertices, and readers
// believe it; and they look for the end of a head that was cut off for ever.
#pragma once
#include <string_view>

namespace espalier {

/// Throws InputError where a PLY file announces more elements than it has bytes, or its head has no end.
/// Other files pass.
void check_ply_head(std::string_view bytes);

}  // namespace espalier
