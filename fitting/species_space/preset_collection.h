// Presets by the handful: the bundled ones, those of a folder, the results of finished fits.
#pragma once
#include <string>
#include <vector>

#include <espalier/models/preset.h>

namespace espalier {

/// Presets named one by one (as load_preset takes them), the directory of a run (its best.toml), a folder of
/// runs, or a folder of presets; no names: the bundled species, without demonstrations. In the order given,
/// folders sorted by name. A run's preset is called as its directory. Throws InputError for what holds no
/// preset.
std::vector<Preset> load_presets(const std::vector<std::string>& names);

/// The bundled presets of a model, demonstrations too: fits search among them and are compared with them, and
/// one preset less would change what a recorded fit finds. Of an L-system none.
std::vector<Preset> bundled_species(const std::string& model);

}  // namespace espalier
