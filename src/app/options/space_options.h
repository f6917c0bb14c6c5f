// The options of commands that need a species space: which presets, which encoding, or a saved file.
#pragma once
#include <string>
#include <vector>

#include <espalier/fitting/species_space/species_space.h>

namespace CLI {
class App;
}

namespace espalier {

struct SpaceOptions {
  std::vector<std::string> presets;  ///< none: the bundled ones
  std::string encoding = "monotone";
  std::string file;  ///< a saved space, instead of the others
};

/// Adds --presets, --encoding and --space.
void add_space_options(CLI::App& command, SpaceOptions& options);

/// The space with `components`, which a saved one must have; 0: 2, or what the saved one has. Throws
/// InputError.
SpeciesSpace load_space(const SpaceOptions& options, int components);

}  // namespace espalier
