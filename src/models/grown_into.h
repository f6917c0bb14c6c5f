// The pictures a preset's tree is grown into, as a preset names them:
//   [[grown_into]]
//   outline = "outline.png"   # beside the preset; what is white is left to the tree
//   metres_per_px = 0.09      # and where the base of the tree stands, and where the camera looks from
// Source: environment/picture_envelope.h.
#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <espalier/core/toml/toml_section.h>
#include <espalier/environment/volume.h>
#include <espalier/render/camera.h>

namespace espalier {

struct GrownInto {
  std::filesystem::path outline;  ///< a mask
  View view;
  float metres_per_px = 0.1f, base_row_px = 0;
};

/// The key of a preset that holds them.
inline constexpr const char* kGrownIntoKey = "grown_into";

/// Paths are relative to `folder`. Throws InputError with file, line, key, got and expected.
std::vector<GrownInto> read_grown_into(const TomlSection& preset, const std::filesystem::path& folder);

/// The text read_grown_into reads back, files named without their folder; empty for none.
std::string grown_into_to_toml(const std::vector<GrownInto>& pictures);

/// The volume they leave; null for none. Throws InputError for pictures that cannot be read.
std::unique_ptr<Volume> envelope_of(const std::vector<GrownInto>& pictures);

}  // namespace espalier
