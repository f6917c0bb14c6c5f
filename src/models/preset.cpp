#include "models/preset.h"

#include <algorithm>

#include "core/error.h"
#include "core/toml_file.h"
#include "models/models.h"
#include "models/preset_reader.h"
#include "models/preset_source.h"

namespace espalier {

namespace {

const std::vector<std::string> kPresetKeys = {"name", "description", "model", "extends"};

/// The text under a key of the preset itself, if it is there.
std::optional<std::string> read_text(const toml::table& document, const std::string& source,
                                     std::string_view key) {
  const toml::node* node = document.get(key);
  if (!node) return std::nullopt;
  if (auto text = node->value_exact<std::string>()) return text;
  throw_input_error("{}: key '{}': got {}, expected a string", toml_location(source, *node), key,
                    describe_toml(*node));
}

/// The identities of the presets that lead to this one by `extends`.
using Chain = std::vector<std::string>;

Preset load_chain(const PresetSource& source, Chain& chain);

/// A preset of the model's defaults.
Preset load_defaults(const toml::table& document, const PresetSource& source) {
  const auto model = read_text(document, source.label, "model");
  if (!model)
    throw_input_error("{}: got no key 'model' or 'extends', expected model = \"{}\"", source.label,
                      fmt::join(model_names(), "\" or \""));
  try {
    return {"", "", *model, model_by_name(*model).table().defaults()};
  } catch (const InputError& error) {
    throw_input_error("{}: key 'model': {}", toml_location(source.label, *document.get("model")),
                      error.what());
  }
}

PresetSource find_base(const PresetSource& source, const std::string& extends, const std::string& where) {
  try {
    return find_preset(extends, source.folder);
  } catch (const InputError& error) {
    throw_input_error("{}: key 'extends': {}", where, error.what());
  }
}

/// The preset that `document` extends, or the defaults of its model.
Preset load_base(const toml::table& document, const PresetSource& source, Chain& chain) {
  const auto extends = read_text(document, source.label, "extends");
  if (!extends) return load_defaults(document, source);
  const std::string where = toml_location(source.label, *document.get("extends"));
  const PresetSource base_source = find_base(source, *extends, where);
  if (std::find(chain.begin(), chain.end(), base_source.identity) != chain.end())
    throw_input_error("{}: key 'extends': got '{}', which leads back to itself, expected no cycle", where,
                      *extends);
  Preset base = load_chain(base_source, chain);
  const auto model = read_text(document, source.label, "model");
  if (model && *model != base.model)
    throw_input_error("{}: key 'model': got '{}', expected '{}' as in '{}'",
                      toml_location(source.label, *document.get("model")), *model, base.model, *extends);
  return base;
}

Preset load_chain(const PresetSource& source, Chain& chain) {
  chain.push_back(source.identity);
  const toml::table document = parse_toml(source.text, source.label);
  Preset preset = load_base(document, source, chain);
  preset.name = read_text(document, source.label, "name").value_or(source.name);
  preset.description = read_text(document, source.label, "description").value_or(preset.description);
  read_parameters(document, source.label, model_by_name(preset.model).table(), kPresetKeys, preset.values);
  return preset;
}

}  // namespace

std::vector<std::string> bundled_presets() {
  std::vector<std::string> names;
  for (const EmbeddedFile& file : embedded_presets()) names.emplace_back(file.name);
  return names;
}

Preset load_preset(const std::string& name_or_path) {
  if (name_or_path.ends_with(".lsys"))  // an L-system with its defaults
    return {std::filesystem::path(name_or_path).stem().string(), "", name_or_path,
            model_by_name(name_or_path).table().defaults()};
  Chain chain;
  return load_chain(find_preset(name_or_path, {}), chain);
}

}  // namespace espalier
