#include <fmt/format.h>

#include <algorithm>

#include <espalier/core/files.h>
#include <espalier/core/text/text_hash.h>
#include <espalier/core/text/utf8.h>
#include <espalier/fitting/record/start_names.h>
#include <espalier/fitting/run/run_files.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>

namespace espalier {

namespace fs = std::filesystem;

namespace {

const fs::path kModelFolder = "model", kPresetsFolder = "presets";

bool is_users_preset(const std::string& name) {
  const std::vector<std::string> bundled = bundled_names();
  std::error_code none;
  return std::find(bundled.begin(), bundled.end(), name) == bundled.end() && fs::is_regular_file(name, none);
}

bool is_there_as_it_is(const RunFile& file, const fs::path& directory) {
  std::error_code none;
  return fs::is_regular_file(directory / file.name, none) && read_file(directory / file.name) == file.text;
}

class Keeper {
 public:
  Keeper(const FitRecord& record, const Model& model) : kept_{record, {}} {
    kept_.record.files.clear();
    keep_model(model);
    FitRecord& named = kept_.record;
    named.start = start_with(record.start, [&](const std::string& name) { return keep_preset(name); });
    if (!named.species.empty()) named.species = keep_preset(named.species);
  }

  KeptFiles take() {
    for (const RunFile& file : kept_.files)
      kept_.record.files[as_utf8(file.name.string())] = text_hash(file.text);
    return std::move(kept_);
  }

 private:
  void add(const fs::path& name, std::string text) {
    const bool is_known = std::any_of(kept_.files.begin(), kept_.files.end(),
                                      [&](const RunFile& file) { return file.name == name; });
    if (!is_known) kept_.files.push_back({name, std::move(text)});
  }

  void keep_model(const Model& model) {
    for (const fs::path& file : model.files())
      add(kModelFolder / as_utf8(file.filename().string()), read_file(file));
    is_model_kept_ = !kept_.files.empty();
    if (is_model_kept_) kept_.record.model = kept_.files.front().name.string();
  }

  /// Two presets may have one file name.
  fs::path free_name(const std::string& stem, const std::string& text) const {
    fs::path name = kPresetsFolder / (stem + ".toml");
    for (int i = 2;; ++i) {
      const auto taken = std::find_if(kept_.files.begin(), kept_.files.end(),
                                      [&](const RunFile& file) { return file.name == name; });
      if (taken == kept_.files.end() || taken->text == text) return name;
      name = kPresetsFolder / fmt::format("{}_{}.toml", stem, i);
    }
  }

  std::string keep_preset(const std::string& name) {
    if (!is_users_preset(name)) return name;
    Preset preset = load_preset(name);
    const ParameterTable& table = model_by_name(preset.model).table();
    preset.grown_into.clear();  // a start has values and overrides alone
    if (is_model_kept_) preset.model = (".." / fs::path(kept_.record.model)).string();
    std::string text = preset_to_toml(preset, table);
    const fs::path file = free_name(as_utf8(fs::path(name).stem().string()), text);
    add(file, std::move(text));
    return file.string();
  }

  KeptFiles kept_;
  bool is_model_kept_ = false;
};

}  // namespace

KeptFiles files_to_keep(const FitRecord& record, const Model& model) { return Keeper(record, model).take(); }

void keep_files(const std::vector<RunFile>& files, const fs::path& directory) {
  for (const RunFile& file : files) {
    std::error_code none;
    fs::create_directories((directory / file.name).parent_path(), none);
    if (!is_there_as_it_is(file, directory)) write_file_atomically(directory / file.name, file.text);
  }
}

}  // namespace espalier
