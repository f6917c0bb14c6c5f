#include <CLI/CLI.hpp>

#include <espalier/app/options/space_options.h>
#include <espalier/core/error.h>
#include <espalier/fitting/species_space/preset_collection.h>
#include <espalier/fitting/species_space/species_space_file.h>

namespace espalier {

void add_space_options(CLI::App& command, SpaceOptions& options) {
  CLI::Option* presets = command
                             .add_option("--presets", options.presets,
                                         "presets, folders of them, runs or folders of runs: A,B,… (default: "
                                         "the bundled species)")
                             ->delimiter(',')
                             ->allow_extra_args(false);
  command.add_option("--encoding", options.encoding, "monotone, or raw: the parameter list as it is")
      ->capture_default_str();
  command.add_option("--space", options.file, "a space saved by espalier space --save")->excludes(presets);
}

SpeciesSpace load_space(const SpaceOptions& options, int components) {
  constexpr int kDefault = 2;
  if (options.file.empty()) {
    const std::vector<Preset> presets = load_presets(options.presets);
    return make_species_space(presets, options.encoding, components == 0 ? kDefault : components);
  }
  SpeciesSpace space = read_species_space(options.file);
  if (components != 0 && components != space.dimension())
    throw_input_error("--space: got {} components in {}, expected {}", space.dimension(), options.file,
                      components);
  return space;
}

}  // namespace espalier
