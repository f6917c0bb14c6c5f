// The text of an L-system file, and messages that point into it: "fern.lsys:12:7: got ')', expected …".
// Everything read from a file keeps its offset, so that errors of a derivation name the place too.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <espalier/core/error.h>
#include <espalier/core/text/one_line.h>

namespace espalier::lsystem {

/// The files that an L-system was read from, its own first; included ones and those of its plants add theirs.
using ReadFiles = std::vector<std::filesystem::path>;

/// How much may be read for one L-system.
inline constexpr std::size_t kMostTextBytes = 4u << 20;  ///< of all its .lsys files
inline constexpr std::uintmax_t kMostAssetBytes = 64u << 20;
inline constexpr int kMostAssets = 100;  ///< meshes, patches, pictures, functions

/// What was read for an L-system so far, by all its files.
struct ReadSoFar {
  std::size_t text_bytes = 0;
  std::uintmax_t asset_bytes = 0;
  int assets = 0;
};

/// Where the lines of a text start.
std::vector<std::size_t> find_line_starts(std::string_view text);

struct Source {
  std::string label;             ///< what messages call the file
  std::filesystem::path folder;  ///< where its includes are
  std::string text;
  bool may_read_files = true;   ///< meshes and pictures in the folder
  bool may_have_plants = true;  ///< of other L-systems; those have none
  std::shared_ptr<ReadFiles> files = std::make_shared<ReadFiles>();
  std::shared_ptr<ReadSoFar> so_far = std::make_shared<ReadSoFar>();
  std::vector<std::size_t> line_starts = find_line_starts(text);

  /// From 1.
  std::size_t line_of(std::size_t offset) const;
};

/// A place in a file. Files are shared, because included ones outlive their reading.
struct Position {
  std::shared_ptr<const Source> source;
  std::size_t offset = 0;
};

/// "file:line:column", both from 1; "L-system" for a position in no file.
std::string describe(const Position& position);

/// Of a message that quotes what a file says.
inline constexpr std::size_t kLongestMessage = 300;

template <typename... Args>
[[noreturn]] void throw_at(const Position& position, fmt::format_string<Args...> format, Args&&... args) {
  throw InputError(one_line(describe(position) + ": " + fmt::format(format, std::forward<Args>(args)...),
                            kLongestMessage));
}

/// The path of a mesh, a picture or the like beside the source, which is noted as read. Throws InputError
/// where there is something that is neither a file nor a folder, as a pipe, which would never end, and past
/// the limits.
std::filesystem::path note_file(const std::string& name, const Source& source);

/// The text of an .lsys file. Throws InputError where it is no regular file, or too large with those before
/// it.
std::string read_text(const std::filesystem::path& path, ReadSoFar& so_far);

/// What a message quotes of a text that may be long: its first 80 bytes.
std::string shortened(std::string_view text);

/// What a message calls the text at an offset: "'x'", "the end of the line" or "the end of the file".
std::string found_at(std::string_view text, std::size_t offset);

}  // namespace espalier::lsystem
