// espalier species: lists the bundled presets, prints one in full, checks a file.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <espalier/app/commands/commands.h>
#include <espalier/app/options/json_output.h>
#include <espalier/models/grow_preset.h>
#include <espalier/models/models.h>
#include <espalier/overrides/overrides_tree.h>

namespace espalier {

namespace {

struct SpeciesOptions {
  std::string preset;
  std::string file_to_check;
  bool json = false;
};

/// "13 ± 3 m": the height of the tree, where the model has one.
std::string height_text(const Preset& preset) {
  const ParameterTable& table = model_by_name(preset.model).table();
  const auto height = table.find(Role::tree_scale), variation = table.find(Role::tree_scale_variation);
  if (!height || !variation) return "";
  return fmt::format("{} ± {} m", preset.values[*height], preset.values[*variation]);
}

void list_presets(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const Preset preset = load_preset(name);
    fmt::print("{:<19} {:<12} {}\n", name, height_text(preset), preset.description);
  }
}

nlohmann::ordered_json presets_to_json(const std::vector<std::string>& names, bool is_species) {
  auto rows = nlohmann::ordered_json::array();
  for (const std::string& name : names) {
    const Preset preset = load_preset(name);
    rows.push_back({{"name", name},
                    {"is_species", is_species},
                    {"model", preset.model},
                    {"height", height_text(preset)},
                    {"description", preset.description}});
  }
  return rows;
}

void print_species_json() {
  nlohmann::ordered_json all = presets_to_json(bundled_presets(), true);
  for (auto& design : presets_to_json(bundled_designs(), false)) all.push_back(std::move(design));
  print_as_json(all);
}

void list_species() {
  list_presets(bundled_presets());
  fmt::print("\nDesigned branch by branch, and no species:\n");
  list_presets(bundled_designs());
  fmt::print("\nL-systems are listed by espalier lsystem.\n");
}

/// Of the one tree that the preset stands for: splits, bends and overrides make it lower than its parameters
/// say.
std::string grown_height_text(const Preset& preset, const std::string& file) {
  const Bounds box = bounds(grow_preset(preset, file));
  return fmt::format("{:.2f} m", box.upper.z - box.lower.z);
}

void check_file(const std::string& file) {
  const Preset preset = load_preset(file);
  fmt::print("ok {}: {}, model {}, height {}\n", file, preset.name, preset.model,
             preset.seed ? grown_height_text(preset, file) : height_text(preset));
}

/// The overrides of single branches as a tree in comments; dormant ones are those that do not grow with
/// its seed.
std::string branches_text(const Preset& preset) {
  const std::vector<std::size_t> branches = count_overridden(preset, preset.name);
  return fmt::format("\n# Branches that are overridden, as they grow with seed {}:\n", seed_of(preset)) +
         overrides_tree(preset.overrides, branches, "# ");
}

void print_preset(const Preset& preset) {
  fmt::print("{}", preset_to_toml(preset));
  if (!preset.overrides.empty()) fmt::print("{}", branches_text(preset));
}

void run_species(const SpeciesOptions& options) {
  if (!options.file_to_check.empty())
    check_file(options.file_to_check);
  else if (!options.preset.empty())
    print_preset(load_preset(options.preset));
  else if (options.json)
    print_species_json();
  else
    list_species();
}

}  // namespace

void add_species_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("species", "List the bundled presets, print one as TOML, or check a file");
  const auto options = std::make_shared<SpeciesOptions>();
  CLI::Option* preset = command->add_option("preset", options->preset, "a bundled preset or a TOML file");
  command->add_option("--check", options->file_to_check, "say whether this TOML file is a valid preset")
      ->excludes(preset);
  command->add_flag("--json", options->json, "list as JSON")->excludes(preset);
  command->callback([options] { run_species(*options); });
}

}  // namespace espalier
