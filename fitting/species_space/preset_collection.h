// Presets by the handful: the bundled ones, those of a folder, the results of finished fits.
#pragma once
#include <string>
#include <vector>

#include <espalier/models/preset.h>

namespace espalier {

/// Presets named one by one (as load_preset takes them), the directory of a run (its best.toml), a folder of
/// runs, or a folder of presets; no names: the bundled ones. In the order given, folders sorted by name. A
/// run's preset is called as its directory. Throws InputError for what holds no preset.
std::vector<Preset> load_presets(const std::vector<std::string>& names);

/// The bundled species of a model; of an L-system none.
std::vector<Preset> bundled_species(const std::string& model);

}  // namespace espalier
