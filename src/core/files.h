// Files are written whole or not at all: bytes go to a temporary file beside the target, which is then
// renamed over it. A killed program or a full disk leaves the old file, or none.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace espalier {

/// Replaces the file `path`. Throws InputError with one line (path and reason) where it cannot.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

using TakeBytes = std::function<void(std::string_view bytes)>;

/// The same of bytes that come piece by piece: `write` is called once, with what takes them. Where it throws,
/// the old file stays.
void write_file_atomically(const std::filesystem::path& path,
                           const std::function<void(const TakeBytes& take)>& write);

/// The whole file. Throws InputError with one line (path and reason) where it cannot be read.
std::string read_file(const std::filesystem::path& path);

}  // namespace espalier
