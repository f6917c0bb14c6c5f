// Where the text of a preset comes from: bundled with the program (embedded when it is built, from
// src/*/species/*.toml and src/*/designs/*.toml) or a file of the user's.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include <espalier/core/embedded_file.h>

namespace espalier {

/// The bundled species, sorted by name.
std::span<const EmbeddedFile> embedded_presets();

/// Plants that were designed branch by branch, sorted by name.
std::span<const EmbeddedFile> embedded_designs();

struct PresetSource {
  std::string label;             ///< what messages call it: the path as given, or "quaking_aspen (bundled)"
  std::string identity;          ///< the same for the same preset, however it was named; tells cycles
  std::string name;              ///< the preset's name unless it says another
  std::filesystem::path folder;  ///< where relative paths in it start
  std::string text;
};

/// Finds and reads the preset; a bundled name comes first, then a path relative to `folder`.
/// Throws InputError where there is neither, naming the closest bundled one, or the file is no text.
PresetSource find_preset(const std::string& name_or_path, const std::filesystem::path& folder);

}  // namespace espalier
