#include <vector>

#include <espalier/core/error.h>
#include <espalier/core/near_name.h>
#include <espalier/core/parameter_table.h>
#include <espalier/core/toml/toml_file.h>
#include <espalier/lsystem/files/bundled.h>
#include <espalier/models/preset.h>
#include <espalier/models/preset_source.h>

namespace espalier {

namespace fs = std::filesystem;

namespace {

bool looks_like_path(const std::string& text) {
  return text.find('/') != std::string::npos || text.ends_with(".toml");
}

PresetSource bundled_source(const EmbeddedFile& file) {
  const std::string name(file.name);
  return {name + " (bundled)", name, name, {}, std::string(file.text)};
}

PresetSource file_source(const std::string& given, const fs::path& folder) {
  const fs::path path = folder / given;
  std::string text = read_toml_text(path);
  return {path.string(), fs::weakly_canonical(path).string(), path.stem().string(), path.parent_path(),
          std::move(text)};
}

}  // namespace

PresetSource find_preset(const std::string& name_or_path, const fs::path& folder) {
  for (const auto& bundled : {embedded_presets(), embedded_designs()})
    for (const EmbeddedFile& file : bundled)
      if (file.name == name_or_path) return bundled_source(file);
  std::error_code ignored;
  if (looks_like_path(name_or_path) || fs::exists(folder / name_or_path, ignored))
    return file_source(name_or_path, folder);
  for (const EmbeddedFile& file : embedded_lsystems())
    if (file.name == name_or_path)
      throw_input_error("got preset '{}', expected its ending: '{}.lsys' is a bundled L-system", name_or_path,
                        name_or_path);
  throw_input_error("got preset '{}', expected a path or a bundled preset, the closest is '{}'", name_or_path,
                    closest_name(name_or_path, bundled_names()));
}

}  // namespace espalier
