// A picture of the tree and where it was taken from, as words, as a table of run.toml, and checked.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include <espalier/core/toml/toml_section.h>
#include <espalier/render/camera.h>

namespace espalier {

struct ViewRecord {
  std::filesystem::path picture;
  View view;
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
