// Growing the tree of a preset as its file says: with its seed, its overrides, and inside of its outlines.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <espalier/models/preset.h>
#include <espalier/plant/plant.h>

namespace espalier {

/// The seed of the preset's tree where nobody asks for another: its own, of a species 1.
Seed seed_of(const Preset& preset);

struct PresetGrowth {
  std::optional<Seed> seed = {};     ///< instead of the preset's
  const Volume* prune_to = nullptr;  ///< instead of the outlines that the preset was grown into; not owned
  std::optional<int> steps = {};     ///< instead of all, of a model that grows in steps
};

/// Throws InputError, which opens with `name`, where the tree would be larger than growth allows, or where
/// its model is asked for steps and has none.
Plant grow_preset(const Preset& preset, const std::string& name, const PresetGrowth& growth = {});

/// How many stems of the preset's tree each of its overrides is of (count_branches,
/// overrides/overrides_tree.h). Throws InputError as grow_preset does.
std::vector<std::size_t> count_overridden(const Preset& preset, const std::string& name);

}  // namespace espalier
