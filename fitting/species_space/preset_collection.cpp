#include <algorithm>
#include <filesystem>

#include <espalier/core/field_error.h>
#include <espalier/fitting/species_space/preset_collection.h>

namespace espalier {

namespace {

namespace fs = std::filesystem;

constexpr const char* kBest = "best.toml";

std::vector<fs::path> sorted_entries(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> paths;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    paths.push_back(entry.path());
  if (error)
    throw_field_error("presets", "{}: got '{}', expected a folder that can be read", folder.string(),
                      error.message());
  std::sort(paths.begin(), paths.end());
  return paths;
}

Preset load_best(const fs::path& run) {
  Preset preset = load_preset((run / kBest).string());
  preset.name = run.filename().string();
  return preset;
}

void load_folder(const fs::path& given, std::vector<Preset>& presets) {
  const fs::path folder = given.filename().empty() ? given.parent_path() : given;  // "runs/" is "runs"
  const std::size_t before = presets.size();
  std::error_code ignored;
  if (fs::exists(folder / kBest, ignored)) {
    presets.push_back(load_best(folder));
    return;
  }
  for (const fs::path& path : sorted_entries(folder))
    if (fs::exists(path / kBest, ignored))
      presets.push_back(load_best(path));
    else if (path.extension() == ".toml")
      presets.push_back(load_preset(path.string()));
  if (presets.size() == before)
    throw_field_error("presets", "got '{}' without presets, expected *.toml or runs with {}", given.string(),
                      kBest);
}

std::vector<Preset> load_bundled() {
  std::vector<Preset> presets;
  for (const std::string& name : bundled_presets()) presets.push_back(load_preset(name));
  return presets;
}

}  // namespace

std::vector<Preset> load_presets(const std::vector<std::string>& names) {
  std::vector<Preset> presets = names.empty() ? load_bundled() : std::vector<Preset>{};
  std::erase_if(presets, [](const Preset& preset) { return preset.demonstration; });
  std::error_code ignored;
  for (const std::string& name : names)
    if (fs::is_directory(name, ignored))
      load_folder(name, presets);
    else
      presets.push_back(load_preset(name));
  return presets;
}

std::vector<Preset> bundled_species(const std::string& model) {
  std::vector<Preset> presets = load_bundled();
  std::erase_if(presets, [&](const Preset& preset) { return preset.model != model; });
  return presets;
}

}  // namespace espalier
