// The options of commands that grow one plant, and the growing: preset, --seed, --set, --steps, --prune-to.
// Shared by mesh, mask and render, so that the same words grow the same plant everywhere.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <espalier/core/parameter_table.h>
#include <espalier/core/random.h>
#include <espalier/environment/volume.h>
#include <espalier/plant/plant.h>
#include <espalier/plant/plant_colors.h>

namespace CLI {
class App;
}

namespace espalier {

struct PlantOptions {
  std::string preset;                    ///< a bundled preset's name, or a file
  std::optional<Seed> seed;              ///< of the random numbers; none: the preset's
  std::vector<std::string> assignments;  ///< "name=value", after the preset, in order
  std::string prune_to;                  ///< a volume as text (environment/volume.h), empty for none
  std::optional<int> steps;              ///< of an L-system, from 0; none: those the file says
};

/// Adds the positional PRESET and the options --seed, --set, --steps and --prune-to to a command.
void add_plant_options(CLI::App& command, PlantOptions& options);

/// Sets what "name=value" says, in order. Throws FieldError for unknown names and values out of bounds.
void set_parameters(const std::vector<std::string>& assignments, const ParameterTable& table,
                    ParameterValues& values);

/// A volume as text (environment/volume.h), or "FILE.lsys:NAME", one that an L-system declares, with its
/// default parameters. Metres. Throws InputError.
std::unique_ptr<Volume> read_volume(const std::string& text);

/// Of the preset's species.
PlantColors colors_of(const PlantOptions& options);

/// Grows the plant. Throws InputError for an unknown preset or parameter, a value outside its bounds, a bad
/// volume, or a plant that would exceed the growth budget.
Plant grow_plant(const PlantOptions& options);

}  // namespace espalier
