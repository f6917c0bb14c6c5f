// Presets: parameter values of a model as TOML, bundled (by name) or the user's (by path).
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <espalier/core/parameter_table.h>
#include <espalier/core/random.h>
#include <espalier/models/grown_into.h>
#include <espalier/overrides/overrides.h>
#include <espalier/plant/plant_colors.h>

namespace espalier {

struct Preset {
  std::string name;                        ///< "quaking_aspen", or the file's stem
  std::string description;                 ///< one line, may be empty
  std::string model;                       ///< "weber_penn"
  ParameterValues values;                  ///< in the order of the model's table
  Overrides overrides = {};                ///< of single branches
  std::vector<GrownInto> grown_into = {};  ///< pictures whose outlines the tree stays inside of
  std::optional<Seed> seed = {};           ///< of the one tree it stands for; none: of a species
  bool demonstration = false;              ///< shows what the model can do, and is no species
  PlantColors colors = {};                 ///< of its species
};

/// Names of the bundled species, sorted.
std::vector<std::string> bundled_presets();

/// Names of the bundled plants that were designed branch by branch, sorted. They are no species: fits do not
/// start from them, and they are not on the map.
std::vector<std::string> bundled_designs();

/// Both: what load_preset finds by name.
std::vector<std::string> bundled_names();

/// A bundled preset by name, or any preset by path. `extends` is followed. Throws InputError with
/// file, line, key, got and expected for unknown keys, wrong types and values outside their bounds.
Preset load_preset(const std::string& name_or_path);

/// The preset as TOML that load_preset reads back to the same bits. The second form is for models that are
/// not known by name: `table` is that of the preset's model.
std::string preset_to_toml(const Preset& preset);
std::string preset_to_toml(const Preset& preset, const ParameterTable& table);

}  // namespace espalier
