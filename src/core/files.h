// Files are written whole or not at all: bytes go to a temporary file beside the target, which is then
// renamed over it. A killed program or a full disk leaves the old file, or none.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace espalier {

/// Replaces the file `path`. Throws InputError with one line (path and reason) where it cannot.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

/// The whole file. Throws InputError with one line (path and reason) where it cannot be read.
std::string read_file(const std::filesystem::path& path);

}  // namespace espalier
