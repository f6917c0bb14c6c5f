#include <algorithm>

#include <espalier/core/error.h>
#include <espalier/core/toml/toml_file.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>
#include <espalier/models/preset_reader.h>
#include <espalier/models/preset_source.h>
#include <espalier/overrides/change_graph.h>
#include <espalier/overrides/overrides_toml.h>

namespace espalier {

namespace {

const std::vector<std::string> kPresetKeys = {"name",          "description", "model",      "extends",
                                              "seed",          "branch",      "shared",     kGrownIntoKey,
                                              "demonstration", "bark_color",  "leaf_color", "autumn_color"};

/// The text under a key of the preset itself, if it is there.
std::optional<std::string> read_text(const toml::table& document, const std::string& source,
                                     std::string_view key) {
  const toml::node* node = document.get(key);
  if (!node) return std::nullopt;
  if (auto text = node->value_exact<std::string>()) return text;
  throw_input_error("{}: key '{}': got {}, expected a string", toml_location(source, *node), key,
                    describe_toml(*node));
}

std::optional<Seed> read_seed(const toml::table& document, const std::string& source) {
  const toml::node* node = document.get("seed");
  if (!node) return std::nullopt;
  // TOML has no whole numbers above 2^63 - 1: larger seeds are negative, as in run.toml.
  if (const auto seed = node->value_exact<std::int64_t>()) return static_cast<Seed>(*seed);
  throw_input_error("{}: key 'seed': got {}, expected a whole number", toml_location(source, *node),
                    describe_toml(*node));
}

bool read_demonstration(const toml::table& document, const std::string& source) {
  const toml::node* node = document.get("demonstration");
  if (!node) return false;
  if (const auto is_one = node->value_exact<bool>()) return *is_one;
  throw_input_error("{}: key 'demonstration': got {}, expected true or false", toml_location(source, *node),
                    describe_toml(*node));
}

void read_color(const toml::table& document, const std::string& source, std::string_view key,
                PartColor& color) {
  const auto text = read_text(document, source, key);
  if (!text) return;
  const auto read = parse_color(*text);
  if (!read)
    throw_input_error("{}: key '{}': got '{}', expected a colour such as \"#ece9e2\"",
                      toml_location(source, *document.get(key)), key, *text);
  color = *read;
}

/// The identities of the presets that lead to this one by `extends`.
using Chain = std::vector<std::string>;
constexpr std::size_t kLongestExtending = 64;

Preset load_chain(const PresetSource& source, Chain& chain);

/// A preset of the model's defaults.
Preset load_defaults(const toml::table& document, const PresetSource& source) {
  const auto model = read_text(document, source.label, "model");
  if (!model)
    throw_input_error("{}: got no key 'model' or 'extends', expected model = \"{}\"", source.label,
                      fmt::join(model_names(), "\" or \""));
  const std::string found = model_from(source.folder, *model);
  try {
    return {"", "", found, model_by_name(found).table().defaults()};
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
  if (chain.size() > kLongestExtending)
    throw_input_error("{}: key 'extends': got a chain of more than {} presets, expected fewer", where,
                      kLongestExtending);
  Preset base = load_chain(base_source, chain);
  const auto model = read_text(document, source.label, "model");
  if (model && !is_same_model(model_from(source.folder, *model), base.model))
    throw_input_error("{}: key 'model': got '{}', expected '{}' as in '{}'",
                      toml_location(source.label, *document.get("model")), *model, base.model, *extends);
  return base;
}

/// A node of the preset, of one branch or of several.
struct AnyNode {
  BranchPattern pattern;
  const OverrideSet& set;
};

std::vector<AnyNode> all_nodes(const Overrides& overrides) {
  std::vector<AnyNode> nodes;
  nodes.reserve(overrides.nodes.size() + overrides.ranges.size());
  for (const OverrideNode& node : overrides.nodes) nodes.push_back({as_pattern(node.path), node.set});
  for (const RangeNode& node : overrides.ranges) nodes.push_back({node.pattern, node.set});
  return nodes;
}

/// Where the overrides of this path stand in a document, or the document alone for those of a preset below.
std::string place_of(const BranchPattern& path, const toml::table& document, const PresetSource& source) {
  const toml::array* branches = document["branch"].as_array();
  if (branches)
    for (const toml::node& branch : *branches)
      if (branch.is_table() && (*branch.as_table())["path"].value_or(std::string()) == to_string(path))
        return toml_location(source.label, branch);
  return source.label;
}

/// Throws for what the model could not follow.
void check_abilities(const Preset& preset, const Model& model, const std::string& label) {
  if (!preset.overrides.empty() && !model.has_branch_paths())
    throw_input_error("{}: got overrides of branches, expected none: model '{}' has no paths of branches",
                      label, preset.model);
  if (!preset.grown_into.empty() && !model.can_train())
    throw_input_error("{}: key '{}': got outlines to grow into, expected none: model '{}' cannot", label,
                      kGrownIntoKey, preset.model);
}

/// Throws for overrides, also shared ones, that would have no effect. A seed of 0 asks for none.
void check_quantities(const AnyNode& node, const Preset& preset, const Model& model,
                      const toml::table& document, const PresetSource& source) {
  for (const Override& entry : resolved_overrides(node.set, preset.overrides))
    if (!model.can_change(entry.quantity) && !(entry.quantity == Quantity::seed && entry.number == 0))
      throw_input_error("{}: {}: got one for branch {}, expected none: model '{}' cannot change it",
                        place_of(node.pattern, document, source), quantity_name(entry.quantity),
                        to_string(node.pattern), preset.model);
}

void check_crown(const AnyNode& node, const Preset& preset, const Model& model, const toml::table& document,
                 const PresetSource& source) {
  if (resolved_crown(node.set, preset.overrides) && !model.has_branch_crowns())
    throw_input_error("{}: crown: got one for branch {}, expected none: model '{}' has no crowns of branches",
                      place_of(node.pattern, document, source), to_string(node.pattern), preset.model);
}

/// Throws for paths that no plant of these values can have; those of too few children are dormant.
void check_branches(const Preset& preset, const Model& model, const toml::table& document,
                    const PresetSource& source) {
  check_abilities(preset, model, source.label);
  const BranchLimits limits = model.branch_limits(preset.values);
  for (const AnyNode& node : all_nodes(preset.overrides)) {
    check_quantities(node, preset, model, document, source);
    check_crown(node, preset, model, document, source);
    if (const int levels = level_of(node.pattern) + 1; levels > limits.levels)
      throw_input_error("{}: path: got '{}' of {} levels, expected at most {}",
                        place_of(node.pattern, document, source), to_string(node.pattern), levels,
                        limits.levels);
    if (node.pattern.front().first >= limits.trunks)
      throw_input_error("{}: path: got '{}' on trunk {}, expected a trunk below {}",
                        place_of(node.pattern, document, source), to_string(node.pattern),
                        node.pattern.front().first, limits.trunks);
  }
}

Preset load_chain(const PresetSource& source, Chain& chain) {
  chain.push_back(source.identity);
  const toml::table document = parse_toml(source.text, source.label);
  Preset preset = load_base(document, source, chain);
  preset.name = read_text(document, source.label, "name").value_or(source.name);
  preset.description = read_text(document, source.label, "description").value_or(preset.description);
  if (const auto seed = read_seed(document, source.label)) preset.seed = seed;
  preset.demonstration = read_demonstration(document, source.label);  // what extends one need not be one
  read_color(document, source.label, "bark_color", preset.colors.bark);
  read_color(document, source.label, "leaf_color", preset.colors.leaf);
  read_color(document, source.label, "autumn_color", preset.colors.autumn);
  const Model& model = model_by_name(preset.model);
  read_parameters(document, source.label, model.table(), kPresetKeys, preset.values);
  read_overrides({document, source.label}, model.table(), preset.overrides);
  if (document.contains(kGrownIntoKey))
    preset.grown_into = read_grown_into({document, source.label}, source.folder);
  check_branches(preset, model, document, source);
  return preset;
}

std::vector<std::string> names_of(std::span<const EmbeddedFile> files) {
  std::vector<std::string> names;
  names.reserve(files.size());
  for (const EmbeddedFile& file : files) names.emplace_back(file.name);
  return names;
}

}  // namespace

std::vector<std::string> bundled_presets() { return names_of(embedded_presets()); }

std::vector<std::string> bundled_designs() { return names_of(embedded_designs()); }

std::vector<std::string> bundled_names() {
  std::vector<std::string> names = bundled_presets();
  const std::vector<std::string> designs = bundled_designs();
  names.insert(names.end(), designs.begin(), designs.end());
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
