// The text of an L-system file, and messages that point into it: "fern.lsys:12:7: got ')', expected …".
// Everything read from a file keeps its offset, so that errors of a derivation name the place too.
#pragma once
#include <cstddef>
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

struct Source {
  std::string label;             ///< what messages call the file
  std::filesystem::path folder;  ///< where its includes are
  std::string text;
  bool may_read_files = true;   ///< meshes and pictures in the folder
  bool may_have_plants = true;  ///< of other L-systems; those have none
  std::shared_ptr<ReadFiles> files = std::make_shared<ReadFiles>();
};

/// A place in a file. Files are shared, because included ones outlive their reading.
struct Position {
  std::shared_ptr<const Source> source;
  std::size_t offset = 0;
};

/// "file:line:column", both from 1; "L-system" for a position in no file.
std::string describe(const Position& position);

/// Of a message that quotes what a file says.
inline constexpr std::size_t kLongestMessage = 600;

template <typename... Args>
[[noreturn]] void throw_at(const Position& position, fmt::format_string<Args...> format, Args&&... args) {
  throw InputError(one_line(describe(position) + ": " + fmt::format(format, std::forward<Args>(args)...),
                            kLongestMessage));
}

/// The path of a file beside the source's, which is noted as read. Throws InputError where there is something
/// that is neither a file nor a folder, as a pipe, which would never end.
std::filesystem::path note_file(const std::string& name, const Source& source);

/// What a message calls the text at an offset: "'x'", "the end of the line" or "the end of the file".
std::string found_at(std::string_view text, std::size_t offset);

}  // namespace espalier::lsystem
