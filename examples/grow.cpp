// Grows a tree of a bundled species and writes it as a mesh.
//   grow quaking_aspen aspen.glb
#include <fmt/core.h>

#include <espalier/espalier.h>

using namespace espalier;

int main(int count, char** arguments) {
  if (count != 3) return fmt::print(stderr, "usage: grow SPECIES MESH.glb\n"), 2;
  try {
    // A preset is a list of values for the rows of its model's parameter table.
    Preset preset = load_preset(arguments[1]);
    const Model& model = model_by_name(preset.model);
    if (const auto row = model.table().find("g_scale")) preset.values[*row] = 12;  // metres high

    // A model is a pure function: the same values and seed grow the same plant, bit for bit.
    Plant plant;
    const Seed seed = 1;
    const GrowthResult result = model.generate(preset.values, seed, {}, plant);
    if (!result.grown) return fmt::print(stderr, "too large by {:.1f}\n", result.over_budget_factor), 1;

    const Bounds box = bounds(plant);
    fmt::print("{} stems, {} leaves, {:.1f} m high\n", plant.stems.size(), plant.leaves.size(), box.upper.z);
    export_mesh(plant, arguments[2], {.detail = 0.3f});
  } catch (const InputError& error) {  // one line: where, got, expected
    return fmt::print(stderr, "{}\n", error.what()), 2;
  }
}
