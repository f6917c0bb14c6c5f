// Files are written whole or not at all: bytes go to a temporary file beside the target, which is then
// renamed over it. A killed program, a full disk or a power cut leaves the old file, or none: the bytes are
// on the disk before the rename, and the rename before the call returns.
#pragma once
#include <cstdint>
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

/// With all those above it. Throws InputError where it cannot be made.
void make_directory(const std::filesystem::path& directory);

/// Whether a program that was killed may have left this name beside what it wrote.
bool is_temporary_name(const std::filesystem::path& path);

/// Removes what killed programs left in the directory. Nobody may be writing there.
void remove_temporary_files(const std::filesystem::path& directory);

inline constexpr std::uintmax_t kMostFileBytes = std::uintmax_t{2} << 30;

/// The whole file, which is a regular one: pipes and devices, which may never end, are not opened. Throws
/// InputError with one line (path and reason) where it cannot be read, or has more than `most_bytes`.
std::string read_file(const std::filesystem::path& path, std::uintmax_t most_bytes = kMostFileBytes);

/// As many of its first bytes as there are, up to `most_bytes`; else as above.
std::string read_beginning(const std::filesystem::path& path, std::size_t most_bytes);

}  // namespace espalier
