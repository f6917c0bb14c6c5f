// Reading experiments. Every reader checks the keys of its table, so that a misspelt one is an error.
#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include <espalier/core/assignment.h>
#include <espalier/core/data_path.h>
#include <espalier/core/field_error.h>
#include <espalier/core/toml/toml_section.h>
#include <espalier/environment/volume.h>
#include <espalier/experiments/declaration/experiment.h>
#include <espalier/experiments/declaration/known_truth.h>
#include <espalier/fitting/optimizers/search_method.h>
#include <espalier/fitting/record/fit_options.h>
#include <espalier/fitting/record/option_values.h>
#include <espalier/fitting/record/search_space.h>
#include <espalier/fitting/record/species_components.h>
#include <espalier/fitting/search/space_search.h>
#include <espalier/fitting/starts/start_points.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>

namespace espalier {

namespace fs = std::filesystem;

namespace {

std::string location(const TomlSection& section, std::string_view key) {
  return fmt::format("{}: {}", toml_location(section.source, section.node(key)), key);
}

/// What a check of another part of the program throws, with its place in front.
template <typename Check>
auto located(const std::string& place, Check check) {
  try {
    return check();
  } catch (const FieldError& error) {
    throw_input_error("{}: {}", place, error.complaint);
  } catch (const InputError& error) {
    throw_input_error("{}: {}", place, error.what());
  }
}
template <typename Check>
auto located(const TomlSection& section, std::string_view key, Check check) {
  return located(location(section, key), check);
}

const toml::array& filled_array(const TomlSection& section, std::string_view key) {
  const toml::array& array = section.array(key);
  if (array.empty()) section.fail(key, "at least one value");
  return array;
}

std::int64_t whole_between(const TomlSection& section, std::string_view key, std::int64_t lower,
                           std::int64_t upper, std::int64_t otherwise) {
  const std::int64_t value = section.whole_or(key, otherwise);
  if (section.has(key) && (value < lower || value > upper))
    section.fail(key, fmt::format("a whole number {}..{}", lower, upper));
  return value;
}

double positive(const TomlSection& section, std::string_view key, double otherwise) {
  const double value = section.number_or(key, otherwise);
  if (section.has(key) && !(value > 0 && std::isfinite(value))) section.fail(key, "a number above 0");
  return value;
}

/// An element of an array as a section of its own; a plain string is the value of `shorthand`.
class Element {
 public:
  Element(const TomlSection& parent, std::string_view key, const toml::node& node, std::string_view shorthand)
      : place_(fmt::format("{}: {}", toml_location(parent.source, node), key)),
        section_{node.is_table() ? *node.as_table() : table_, parent.source} {
    if (node.is_table()) return;
    const auto text = node.value_exact<std::string>();
    if (!text) throw_input_error("{}: got {}, expected a string or a table", place_, describe_toml(node));
    table_.insert(shorthand, *text);
  }
  Element(const Element&) = delete;

  const TomlSection& section() const { return section_; }
  const std::string& place() const { return place_; }  ///< for messages

 private:
  toml::table table_;
  std::string place_;
  TomlSection section_;
};

// Targets.

std::vector<std::string> bundled_targets() {
  std::vector<std::string> bundled;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(data_path_or_first("targets"), error))
    if (entry.path().extension() == ".png") bundled.push_back(entry.path().stem());
  std::sort(bundled.begin(), bundled.end());
  return bundled;
}

/// A bundled target by name, or a picture by its path from the working directory or the experiment's file.
fs::path find_picture(const Element& element, const std::string& name) {
  const fs::path beside = fs::path(element.section().source).parent_path() / name;
  std::error_code error;
  for (const fs::path& path : {data_path_or_first("targets") / (name + ".png"), fs::path(name), beside})
    if (fs::is_regular_file(path, error)) return fs::absolute(path);
  throw_input_error("{}: got '{}', expected a picture or a bundled target like '{}'", element.place(), name,
                    closest_name(name, bundled_targets()));
}

TargetDeclaration read_target_declaration(const Element& element) {
  const TomlSection& section = element.section();
  section.expect_only({"picture", "species", "seed", "name"});
  TargetDeclaration target;
  if (section.has("species")) {
    target.species = section.text("species");
    target.seed = static_cast<Seed>(whole_between(section, "seed", 0, 1'000'000'000, 1));
    target.name = section.text_or("name", fs::path(target.species).stem());
    located(section, "species", [&] { return load_preset(target.species); });
    return target;
  }
  target.picture = find_picture(element, section.text("picture"));
  target.name = section.text_or("name", target.picture.stem());
  return target;
}

std::vector<TargetDeclaration> read_targets(const TomlSection& fits) {
  std::vector<TargetDeclaration> targets;
  for (const toml::node& node : filled_array(fits, "targets"))
    targets.push_back(read_target_declaration(Element(fits, "targets", node, "picture")));
  return targets;
}

// Optimisers, objectives, spaces.

std::string label_of(const OptimizerDeclaration& optimizer) {
  std::string label = optimizer.name;
  for (const auto& [name, value] : optimizer.settings) label += fmt::format(" {}={:g}", name, value);
  return label;
}

OptimizerDeclaration read_optimizer(const Element& element) {
  OptimizerDeclaration optimizer;
  const TomlSection& section = element.section();
  optimizer.name = section.text("name");
  for (const auto& [key, value] : section.table)
    if (key != "name" && key != "label")
      optimizer.settings[std::string(key.str())] = section.number(key.str());
  located(element.place(), [&] {
    complete_settings(optimizer.name, optimizer_by_name(optimizer.name).settings(), optimizer.settings);
    return 0;
  });
  optimizer.label = section.text_or("label", label_of(optimizer));
  return optimizer;
}

std::vector<OptimizerDeclaration> read_optimizers(const TomlSection& fits) {
  std::vector<OptimizerDeclaration> optimizers;
  if (!fits.has("optimizers")) return {{"cma_es", "cma_es", {}}};
  for (const toml::node& node : filled_array(fits, "optimizers")) {
    if (node.value_exact<std::string>() == "all")
      for (const auto& optimizer : all_optimizers())
        optimizers.push_back({optimizer->name(), optimizer->name(), {}});
    else
      optimizers.push_back(read_optimizer(Element(fits, "optimizers", node, "name")));
  }
  return optimizers;
}

std::vector<std::string> read_objectives(const TomlSection& fits, const std::string& otherwise) {
  if (!fits.has("objectives")) return {otherwise};
  filled_array(fits, "objectives");
  std::vector<std::string> objectives = fits.texts("objectives");
  std::replace(objectives.begin(), objectives.end(), std::string("fit"), std::string(kFitObjective));
  for (const std::string& objective : objectives) {
    FitRecord record;
    record.objective = objective;
    located(fits, "objectives", [&] { check_option(*find_option("objective"), record); });
  }
  return objectives;
}

SpaceDeclaration read_space(const Element& element, const FitRecord& shared) {
  const TomlSection& section = element.section();
  section.expect_only({"label", "free", "fixed", "first"});
  const Model& model = model_by_name(shared.model);
  SpaceDeclaration space;
  space.label = section.text_or("label", "default");
  if (section.table.size() == 1 && space.label != "default")
    throw_input_error("{}: got '{}' alone, expected \"default\" or a table with free, fixed or first",
                      element.place(), space.label);
  space.first = section.text_or("first", "");
  located(element.place(), [&] {
    FitRecord record = shared;
    for (const char* key : {"free", "fixed"})
      if (section.has(key))
        set_from_request(*find_option(std::string("search.") + key), section.node(key), section.source,
                         record);
    space.search = record.search;
    if (const int components = parse_search_space(space.first)) bundled_species_space(model, components);
    return make_search_space(model.table(), model.table().defaults(), space.search);
  });
  return space;
}

std::vector<SpaceDeclaration> read_spaces(const TomlSection& fits, const FitRecord& shared) {
  if (!fits.has("spaces")) return {SpaceDeclaration{}};
  std::vector<SpaceDeclaration> spaces;
  for (const toml::node& node : filled_array(fits, "spaces"))
    spaces.push_back(read_space(Element(fits, "spaces", node, "label"), shared));
  for (std::size_t i = 0; i < spaces.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (spaces[i].label == spaces[j].label)
        fits.fail("spaces", fmt::format("one space labelled '{}'", spaces[i].label));
  return spaces;
}

std::vector<std::string> read_starts(const TomlSection& fits, const FitRecord& shared) {
  if (!fits.has("starts")) return {"auto"};
  filled_array(fits, "starts");
  std::vector<std::string> starts = fits.texts("starts");
  for (const std::string& start : starts)
    located(fits, "starts",
            [&] { return presets_as_written(model_by_name(shared.model).table(), parse_start(start)); });
  return starts;
}

/// An array of seeds, or how many: 5 is [1, 2, 3, 4, 5].
std::vector<Seed> read_seeds(const TomlSection& fits) {
  std::vector<Seed> seeds;
  if (!fits.has("seeds")) return {1};
  if (!fits.node("seeds").is_array()) {
    const std::int64_t count = whole_between(fits, "seeds", 1, 10'000, 1);
    for (std::int64_t seed = 1; seed <= count; ++seed) seeds.push_back(static_cast<Seed>(seed));
    return seeds;
  }
  for (const toml::node& node : filled_array(fits, "seeds")) {
    const auto seed = node.value_exact<std::int64_t>();
    if (!seed || *seed < 0) fits.fail("seeds", "whole numbers from 0");
    seeds.push_back(static_cast<Seed>(*seed));
  }
  return seeds;
}

void read_view(const TomlSection& fits, View& view) {
  if (!fits.has("view")) return;
  view = located(fits, "view", [&] { return parse_view("picture:" + fits.text("view")).view; });
}

std::vector<bool> read_trained(const TomlSection& fits, const FitRecord& shared) {
  std::vector<bool> trained;
  if (!fits.has("trained")) return {false};
  for (const toml::node& node : filled_array(fits, "trained")) {
    const auto value = node.value_exact<bool>();
    if (!value) fits.fail("trained", "true and false");
    if (*value && !model_by_name(shared.model).can_train())
      fits.fail("trained", fmt::format("false alone: {} cannot grow into a picture", shared.model));
    trained.push_back(*value);
  }
  return trained;
}

TargetGroups groups_in(const TomlSection& fits) {
  TargetGroups groups;
  if (!fits.has("groups")) return groups;
  const TomlSection section = fits.section("groups");
  for (const auto& [name, members] : section.table)
    groups[std::string(name.str())] = section.texts(name.str());
  return groups;
}

/// Members are targets of the experiment, or bundled ones that it leaves out.
TargetGroups read_declared_groups(const TomlSection& fits, const std::vector<TargetDeclaration>& targets) {
  TargetGroups groups = groups_in(fits);
  std::vector<std::string> known = bundled_targets();
  for (const TargetDeclaration& target : targets) known.push_back(target.name);
  for (const auto& [group, members] : groups)
    for (const std::string& member : members)
      if (std::find(known.begin(), known.end(), member) == known.end())
        throw_input_error("{}: got '{}' in group '{}', expected a target like '{}'", location(fits, "groups"),
                          member, group, closest_name(member, known));
  return groups;
}

/// Where the file says something of a field.
std::string place_of(const TomlSection& fits, const std::string& field) {
  const FitOption* option = find_option(field);
  const std::string key = option ? experiment_key(*option) : "";
  return fits.has(key) ? location(fits, key) : fmt::format("{}: {}", fits.source, key.empty() ? field : key);
}

/// What all runs share: the options of espalier fit that no list varies.
FitRecord read_shared_record(const TomlSection& fits) {
  FitRecord record;
  record.views.emplace_back();
  read_view(fits, record.views[0].view);
  if (fits.has("evaluations")) record.budget.seconds = 0;  // given alone they are the only limit
  with_places([&](const std::string& field) { return place_of(fits, field); },
              [&] {
                for (const FitOption& option : fit_options())
                  if (const std::string key = experiment_key(option); fits.has(key))
                    set_from_request(option, fits.node(key), fits.source, record);
                check_record(record);
              });
  located(place_of(fits, "model"), [&] { return &model_by_name(record.model); });
  return record;
}

void check_starts_beside_truth(const TomlSection& fits, const FitsDeclaration& declaration) {
  for (const std::string& start : declaration.starts)
    for (const TargetDeclaration& target : declaration.targets)
      located(place_of(fits, "starts"), [&] { return start_beside_truth(start, target.species); });
}

/// The lists that are varied, what belongs to an experiment alone, and the options that all runs share.
std::vector<std::string> keys_of_fits() {
  std::vector<std::string> keys{"targets",  "optimizers",    "objectives", "spaces",  "starts",
                                "seeds",    "view",          "trained",    "threads", "unseen_seeds",
                                "siblings", "exclude_truth", "groups"};
  for (const FitOption& option : fit_options())
    if (const std::string key = experiment_key(option); !key.empty()) keys.push_back(key);
  return keys;
}

FitsDeclaration read_fits(const TomlSection& fits) {
  fits.expect_only(keys_of_fits());
  FitsDeclaration declaration;
  declaration.record = read_shared_record(fits);
  const FitRecord& shared = declaration.record;
  declaration.targets = read_targets(fits);
  declaration.optimizers = read_optimizers(fits);
  declaration.objectives = read_objectives(fits, shared.objective);
  declaration.spaces = read_spaces(fits, shared);
  declaration.starts = read_starts(fits, shared);
  declaration.seeds = read_seeds(fits);
  declaration.trained = read_trained(fits, shared);
  declaration.threads = static_cast<int>(whole_between(fits, "threads", 1, 1024, 1));
  declaration.groups = read_declared_groups(fits, declaration.targets);
  declaration.unseen_seeds = static_cast<int>(whole_between(fits, "unseen_seeds", 0, 1000, 0));
  declaration.siblings = static_cast<int>(whole_between(fits, "siblings", 0, 1000, 0));
  declaration.exclude_truth = fits.has("exclude_truth") ? fits.flag("exclude_truth") : true;
  if (declaration.exclude_truth) check_starts_beside_truth(fits, declaration);
  return declaration;
}

// Sheets of pictures.

/// A mesh that is not found from the working directory may lie beside the experiment's file.
std::string beside_the_file(const TomlSection& section, const std::string& volume) {
  constexpr std::string_view kMesh = "mesh:";
  std::error_code error;
  if (!volume.starts_with(kMesh) || fs::exists(volume.substr(kMesh.size()), error)) return volume;
  const fs::path beside = fs::path(section.source).parent_path() / volume.substr(kMesh.size());
  return fs::exists(beside, error) ? std::string(kMesh).append(fs::absolute(beside).string()) : volume;
}

PictureChange read_change(const TomlSection& section, const std::string& species) {
  section.expect_only({"label", "species", "blend_with", "t", "set", "prune_to"});
  PictureChange change;
  change.label = section.text_or("label", "");
  change.species = section.text_or("species", "");
  const std::string grown = change.species.empty() ? species : change.species;
  if (section.has("set")) {
    const TomlSection set = section.section("set");
    const Preset preset = located(section, "set", [&] { return load_preset(grown); });
    const ParameterTable& table = model_by_name(preset.model).table();
    change.set = set.numbers();
    for (const auto& entry : change.set)
      located(set, entry.first, [&] {
        check_value(table.rows[table.index_of(entry.first)], entry.second, "parameter " + entry.first);
        return 0;
      });
  } else if (section.has("species")) {
    located(section, "species", [&] { return load_preset(grown); });
  }
  change.blend_with = section.text_or("blend_with", "");
  change.t = section.number_or("t", change.t);
  if (section.has("t") && !(change.t >= 0 && change.t <= 1)) section.fail("t", "a number 0..1");
  if (section.has("blend_with"))
    located(section, "blend_with", [&] { return load_preset(change.blend_with); });
  change.prune_to = beside_the_file(section, section.text_or("prune_to", ""));
  if (!change.prune_to.empty())
    located(section, "prune_to", [&] { return parse_volume(change.prune_to) != nullptr; });
  return change;
}

std::vector<PictureChange> read_changes(const TomlSection& pictures, const char* key,
                                        const std::string& species) {
  if (!pictures.has(key)) return {PictureChange{}};
  filled_array(pictures, key);
  std::vector<PictureChange> changes;
  for (const TomlSection& section : pictures.sections(key)) changes.push_back(read_change(section, species));
  return changes;
}

PicturesDeclaration read_pictures(const TomlSection& pictures) {
  pictures.expect_only({"species", "seed", "size", "frame_m", "rows", "columns"});
  PicturesDeclaration declaration;
  declaration.species = pictures.text("species");
  located(pictures, "species", [&] { return load_preset(declaration.species); });
  declaration.seed = static_cast<Seed>(whole_between(pictures, "seed", 0, 1'000'000'000, 1));
  declaration.size_px = static_cast<int>(whole_between(pictures, "size", 16, 4096, declaration.size_px));
  declaration.frame_m = positive(pictures, "frame_m", 0);
  declaration.rows = read_changes(pictures, "rows", declaration.species);
  declaration.columns = read_changes(pictures, "columns", declaration.species);
  return declaration;
}

// Growth.

GrowthDeclaration read_growth(const TomlSection& growth) {
  growth.expect_only({"species", "seeds"});
  GrowthDeclaration declaration;
  declaration.species = bundled_presets();
  if (growth.has("species")) {
    filled_array(growth, "species");
    declaration.species = growth.texts("species");
    for (const std::string& species : declaration.species)
      located(growth, "species", [&] { return load_preset(species); });
  }
  declaration.seeds = static_cast<int>(whole_between(growth, "seeds", 1, 100'000, declaration.seeds));
  return declaration;
}

const std::vector<std::string> kWords{"title", "figure", "published", "published_fitness", "found", "note"};
const std::vector<std::string> kKinds{"fits", "pictures", "growth"};

/// A file and the words in it.
struct Document {
  toml::table table;
  ExperimentMetadata words;
};

/// Two numbers in [0, 1], the lower first; none where the key is missing.
std::vector<double> read_range(const TomlSection& root, std::string_view key) {
  std::vector<double> range;
  if (!root.has(key)) return range;
  for (const toml::node& node : root.array(key)) range.push_back(node.value<double>().value_or(-1));
  if (range.size() != 2 || !(range[0] >= 0 && range[0] <= range[1] && range[1] <= 1))
    root.fail(key, "two numbers in 0..1, the lower first");
  return range;
}

std::string kind_of(const TomlSection& root) {
  std::vector<std::string> kinds;
  for (const std::string& kind : kKinds)
    if (root.has(kind)) kinds.push_back(kind);
  if (kinds.size() != 1)
    throw_input_error("{}: got {} of the tables [{}], expected one of them", root.source, kinds.size(),
                      fmt::join(kKinds, "], ["));
  return kinds[0];
}

/// KEY=VALUE as TOML: a decimal number, true, false, what looks like TOML, or else a word, with quotes or
/// without.
toml::table parse_setting(const std::string& setting) {
  const auto [key, value] = parse_assignment(setting);
  if (value.empty()) throw_input_error("got '{}', expected KEY=VALUE", setting);
  const bool is_toml = value == "true" || value == "false" || value.find_first_of("[{\"'") == 0;
  const bool is_bare = !is_toml && !parse_decimal(value);
  return parse_toml(fmt::format("{} = {}", key, is_bare ? quote_toml(value) : value), "VALUE");
}

/// The text with these keys of its one table replaced.
std::string with_settings(const std::string& text, const std::string& source,
                          const std::vector<std::string>& settings) {
  if (settings.empty()) return text;
  toml::table table = parse_toml(text, source);
  toml::table& kind = *table[kind_of({table, source})].as_table();
  for (const std::string& setting : settings)
    for (const auto& [key, value] : in_field("set", [&] { return parse_setting(setting); }))
      kind.insert_or_assign(key, value);
  std::ostringstream written;
  written << toml::toml_formatter(table) << "\n";
  return written.str();
}

Document read_document(const fs::path& path, const std::vector<std::string>& settings = {}) {
  Document document;
  ExperimentMetadata& words = document.words;
  words.text = with_settings(read_toml_text(path), path.string(), settings);
  document.table = parse_toml(words.text, path.string());
  const TomlSection root{document.table, path.string()};
  std::vector<std::string> known = kWords;
  known.insert(known.end(), kKinds.begin(), kKinds.end());
  root.expect_only(known);
  words.name = path.stem();
  words.expectations = path.parent_path() / (words.name + ".expected.toml");
  words.kind = kind_of(root);
  words.title = root.text_or("title", words.name);
  words.figure = root.text_or("figure", "");
  words.published = root.text_or("published", "");
  words.found = root.text_or("found", "");
  words.note = root.text_or("note", "");
  words.published_fitness = read_range(root, "published_fitness");
  return document;
}

}  // namespace

ExperimentMetadata read_metadata(const fs::path& path) { return read_document(path).words; }

TargetGroups read_groups(const fs::path& path) {
  const Document document = read_document(path);
  const TomlSection root{document.table, path.string()};
  return root.has("fits") ? groups_in(root.section("fits")) : TargetGroups{};
}

Experiment read_experiment(const fs::path& path, const std::vector<std::string>& settings) {
  const Document document = read_document(path, settings);
  const TomlSection root{document.table, path.string()};
  Experiment experiment{document.words, {}, {}, {}};
  if (root.has("fits")) experiment.fits = read_fits(root.section("fits"));
  if (root.has("pictures")) experiment.pictures = read_pictures(root.section("pictures"));
  if (root.has("growth")) experiment.growth = read_growth(root.section("growth"));
  return experiment;
}

bool same_runs(const std::string& text, const std::string& other_text) {
  const auto runs_of = [](const std::string& source) {
    toml::table table = parse_toml(source, "experiment.toml");
    for (const std::string& word : kWords) table.erase(word);
    return table;
  };
  return runs_of(text) == runs_of(other_text);
}

}  // namespace espalier
