// A picture of the tree and where it was taken from, as words, as a table of run.toml, and checked.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <espalier/core/toml/toml_section.h>
#include <espalier/render/camera.h>

namespace espalier {

/// What tells the file of a picture from others: its size and the FNV-1a hash of its bytes.
struct FileContent {
  std::int64_t bytes = 0;
  std::string hash;  ///< 16 hexadecimal digits

  bool operator==(const FileContent&) const = default;
};

struct ViewRecord {
  std::filesystem::path picture;  ///< as it was given; what is fitted has its name from it
  View view;
  std::optional<FileContent> content = {};  ///< once a run keeps the picture
  std::filesystem::path kept_as =
      {};                           ///< that copy, from the run's directory on; empty: in it (run_pictures.h)
  std::filesystem::path copy = {};  ///< read instead of `picture`, not recorded; empty: none

  const std::filesystem::path& file() const { return copy.empty() ? picture : copy; }
};

/// "FILE", "FILE:azimuth,elevation" or "FILE:azimuth,elevation,field of view" (degrees; with the
/// last one in perspective). Throws FieldError on numbers that are none or out of range.
ViewRecord parse_view(const std::string& text);

/// Throws FieldError where an angle is out of its range.
void check_view(const ViewRecord& view);

/// A table of [[views]]. Throws InputError with file, line, key, got and expected.
ViewRecord read_view(const TomlSection& section);
std::string view_to_toml(const ViewRecord& view);

}  // namespace espalier
