#include <fmt/ranges.h>

#include <algorithm>

#include <espalier/core/data_path.h>
#include <espalier/core/near_name.h>
#include <espalier/core/parameter_table.h>
#include <espalier/experiments/declaration/experiment_keys.h>
#include <espalier/experiments/declaration/fit_lists.h>
#include <espalier/experiments/declaration/known_truth.h>
#include <espalier/experiments/declaration/target_files.h>
#include <espalier/experiments/declaration/toml_values.h>
#include <espalier/fitting/optimizers/search_method.h>
#include <espalier/fitting/record/fit_options.h>
#include <espalier/fitting/record/option_values.h>
#include <espalier/fitting/record/search_space.h>
#include <espalier/fitting/record/species_components.h>
#include <espalier/fitting/search/space_search.h>
#include <espalier/fitting/starts/roomy_budget.h>
#include <espalier/fitting/starts/start_points.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>

namespace espalier {

namespace fs = std::filesystem;

namespace {

constexpr std::int64_t kLargestSeed = 1'000'000'000;

// What a value is in tables, and in the words of a file.

template <typename Value>
std::string as_text(const Value& value) {
  return fmt::format("{}", value);
}

std::string in_braces(const std::vector<std::string>& parts) {
  return fmt::format("{{{}}}", fmt::join(parts, ", "));
}

std::vector<std::string> assignments(const std::map<std::string, double>& values) {
  std::vector<std::string> texts;
  texts.reserve(values.size());
  for (const auto& [name, value] : values) texts.push_back(fmt::format("{} = {:g}", name, value));
  return texts;
}

template <typename Value>
void expect_distinct_texts(const TomlSection& section, std::string_view key,
                           const std::vector<Value>& values) {
  expect_distinct(section, key, values, as_text<Value>, as_text<Value>);
}

// Targets.

/// Nothing of a drawn front view.
std::string describe_view(const ViewRecord& record) {
  const View& view = record.view;
  std::string words = record.picture.string();
  if (view.azimuth_deg != 0 || view.elevation_deg != 0)
    words += fmt::format(":{:g},{:g}", view.azimuth_deg, view.elevation_deg);
  if (view.projection == Projection::perspective) words += fmt::format(",{:g}", view.field_of_view_deg);
  return words;
}

/// Enters where the view's picture lies: a bundled target by name, or a picture by its path from the working
/// directory or the experiment's file; or the copy that the experiment's directory keeps, where that file is
/// in it.
void find_picture(const Element& element, const fs::path& kept_as, ViewRecord& view) {
  const std::string name = view.picture.string();
  const fs::path bundled = data_path_or_first("targets") / (name + ".png");
  std::error_code error;
  for (const fs::path& path : {bundled, fs::path(name), fs::path(beside_the_file(element.section(), name))})
    if (fs::is_regular_file(path, error)) {
      view.picture = fs::absolute(path);
      return;
    }
  view.copy = beside_the_file(element.section(), kept_as.string());
  view.picture = fs::absolute(view.picture);
  if (fs::is_regular_file(view.copy, error)) return;
  throw_input_error("{}: got '{}', expected a picture or a bundled target like '{}'", element.place(), name,
                    closest_name(name, bundled_targets()));
}

/// The views that a target lists behind its first one, which the experiment's key `view` says.
std::vector<ViewRecord> drawn_views(const Element& element, const View& front) {
  std::vector<ViewRecord> views{{{}, front}};
  if (!element.section().has("views")) return views;
  for (const std::string& angles : element.section().texts("views"))
    views.push_back({{}, parse_angles(element.section(), "views", angles)});
  return views;
}

/// The picture without an angle, then those with one, as espalier fit takes them.
std::vector<ViewRecord> pictured_views(const Element& element, const View& front) {
  const TomlSection& section = element.section();
  std::vector<ViewRecord> views;
  if (section.has("picture") || !section.has("views")) views.push_back({section.text("picture"), front});
  if (!section.has("views")) return views;
  filled_array(section, "views");
  for (const std::string& text : section.texts("views"))
    views.push_back(located(section, "views", [&] { return parse_view(text); }));
  return views;
}

TargetDeclaration read_target_declaration(const Element& element, const View& front) {
  const TomlSection& section = element.section();
  section.expect_only(names_of(target_keys()));
  TargetDeclaration target;
  if (section.has("species")) {
    if (section.has("picture")) section.fail("picture", "none of a target with a species, which is drawn");
    target.species = section.text("species");
    if (section.has("seed")) target.seed = static_cast<Seed>(whole_between(section, "seed", 0, kLargestSeed));
    target.name = section.text_or("name", fs::path(target.species).stem());
    target.views = drawn_views(element, front);
    located(section, "species", [&] { return load_preset(target.species); });
    return target;
  }
  target.views = pictured_views(element, front);
  target.name = section.text_or("name", target.views[0].picture.stem());
  for (std::size_t i = 0; i < target.views.size(); ++i) {
    ViewRecord& view = target.views[i];
    find_picture(element, target_file(target.name, i, view.picture.extension()), view);
  }
  return target;
}

// Optimisers and spaces.

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

/// An L-system's plants are not thinned: without a budget of the user's they get room.
GrowthBudget growth_of(const TomlSection& fits, const FitRecord& shared, const std::string& model) {
  const bool is_told = fits.has("max_stems") || fits.has("max_leaves");
  if (is_told || model == FitRecord{}.model) return shared.growth;
  return roomy_budget(model_by_name(model), shared.seed, shared.growth);
}

SpaceDeclaration read_space(const TomlSection& fits, const Element& element, const FitRecord& shared) {
  const TomlSection& section = element.section();
  section.expect_only(names_of(space_keys()));
  SpaceDeclaration space;
  space.label = section.text_or("label", "default");
  if (section.table.size() == 1 && section.has("label") && space.label != "default")
    throw_input_error("{}: got '{}' alone, expected \"default\" or a table with free, fixed, first or model",
                      element.place(), space.label);
  space.model = section.has("model") ? find_model(section, section.text("model")) : shared.model;
  space.first = section.text_or("first", "");
  located(element.place(), [&] {
    const Model& model = model_by_name(space.model);
    FitRecord record = shared;
    record.model = space.model;
    for (const char* key : {"free", "fixed"})
      if (section.has(key))
        set_from_request(*find_option(std::string("search.") + key), section.node(key), section.source,
                         record);
    space.search = record.search;
    if (const int components = parse_search_space(space.first)) bundled_species_space(model, components);
    return make_search_space(model.table(), model.table().defaults(), space.search);
  });
  space.growth = growth_of(fits, shared, space.model);
  return space;
}

/// What `check(model, its name)` throws of the model of any space, with its place in front.
template <typename Check>
void check_models(const TomlSection& fits, std::string_view key, const FitsDeclaration& declaration,
                  Check check) {
  for (const SpaceDeclaration& space : declaration.spaces)
    located(fits, key, [&] {
      check(model_by_name(space.model), space.model);
      return 0;
    });
}

}  // namespace

std::vector<std::string> bundled_targets() {
  std::vector<std::string> bundled;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(data_path_or_first("targets"), error))
    if (entry.path().extension() == ".png") bundled.push_back(entry.path().stem());
  std::sort(bundled.begin(), bundled.end());
  return bundled;
}

std::string describe(const TargetDeclaration& target) {
  std::vector<std::string> parts;
  if (!target.species.empty())
    parts = {fmt::format("species = {}", target.species), fmt::format("seed = {}", target.seed)};
  for (const ViewRecord& view : target.views)
    if (const std::string words = describe_view(view); !words.empty()) parts.push_back(words);
  return in_braces(parts);
}

std::string describe(const OptimizerDeclaration& optimizer) {
  std::vector<std::string> parts = assignments(optimizer.settings);
  parts.insert(parts.begin(), fmt::format("name = {}", optimizer.name));
  return in_braces(parts);
}

std::string describe(const SpaceDeclaration& space) {
  std::vector<std::string> parts;
  if (space.model != FitRecord{}.model) parts.push_back(fmt::format("model = {}", space.model));
  if (!space.search.free.empty())
    parts.push_back(fmt::format("free = [{}]", fmt::join(space.search.free, ", ")));
  if (!space.search.fixed.empty()) parts.push_back("fixed = " + in_braces(assignments(space.search.fixed)));
  if (!space.first.empty()) parts.push_back(fmt::format("first = {}", space.first));
  return parts.empty() ? "default" : in_braces(parts);
}

void read_targets(const TomlSection& fits, FitsDeclaration& declaration) {
  for (const toml::node& node : filled_array(fits, "targets"))
    declaration.targets.push_back(
        read_target_declaration(Element(fits, "targets", node, "picture"), declaration.record.views[0].view));
  expect_distinct(
      fits, "targets", declaration.targets, [](const TargetDeclaration& target) { return target.name; },
      [](const TargetDeclaration& target) { return describe(target); });
}

void read_optimizers(const TomlSection& fits, FitsDeclaration& declaration) {
  declaration.optimizers.clear();
  for (const toml::node& node : filled_array(fits, "optimizers")) {
    if (node.value_exact<std::string>() == "all")
      for (const auto& optimizer : all_optimizers())
        declaration.optimizers.push_back({optimizer->name(), optimizer->name(), {}});
    else
      declaration.optimizers.push_back(read_optimizer(Element(fits, "optimizers", node, "name")));
  }
  expect_distinct(
      fits, "optimizers", declaration.optimizers,
      [](const OptimizerDeclaration& optimizer) { return optimizer.label; },
      [](const OptimizerDeclaration& optimizer) { return describe(optimizer); });
}

void read_objectives(const TomlSection& fits, FitsDeclaration& declaration) {
  filled_array(fits, "objectives");
  std::vector<std::string>& objectives = declaration.objectives;
  objectives = fits.texts("objectives");
  std::replace(objectives.begin(), objectives.end(), std::string("fit"), std::string(kFitObjective));
  for (const std::string& objective : objectives) {
    FitRecord record;
    record.objective = objective;
    located(fits, "objectives", [&] { check_option(*find_option("objective"), record); });
  }
  expect_distinct_texts(fits, "objectives", objectives);
}

void read_spaces(const TomlSection& fits, FitsDeclaration& declaration) {
  declaration.spaces.clear();
  for (const toml::node& node : filled_array(fits, "spaces"))
    declaration.spaces.push_back(
        read_space(fits, Element(fits, "spaces", node, "label"), declaration.record));
  expect_distinct(
      fits, "spaces", declaration.spaces, [](const SpaceDeclaration& space) { return space.label; },
      [](const SpaceDeclaration& space) { return describe(space); });
}

void read_starts(const TomlSection& fits, FitsDeclaration& declaration) {
  filled_array(fits, "starts");
  declaration.starts = fits.texts("starts");
  for (const std::string& start : declaration.starts)
    check_models(fits, "starts", declaration, [&](const Model& model, const std::string& name) {
      presets_as_written(model.table(), parse_start(start_of_model(start, name)));
    });
  expect_distinct_texts(fits, "starts", declaration.starts);
}

void read_trained(const TomlSection& fits, FitsDeclaration& declaration) {
  declaration.trained.clear();
  for (const toml::node& node : filled_array(fits, "trained")) {
    const auto value = node.value_exact<bool>();
    if (!value) fits.fail("trained", "true and false");
    declaration.trained.push_back(*value);
    if (*value)
      check_models(fits, "trained", declaration, [](const Model& model, const std::string& name) {
        if (!model.can_train())
          throw_input_error("got true, expected false alone: {} cannot grow into a picture", name);
      });
  }
  if (std::ranges::count(declaration.trained, true) > 1 || std::ranges::count(declaration.trained, false) > 1)
    fits.fail("trained", "true and false, each once");
}

void read_seeds(const TomlSection& fits, FitsDeclaration& declaration) {
  declaration.seeds.clear();
  if (!fits.node("seeds").is_array()) {
    const std::int64_t count = whole_between(fits, "seeds", 1, 10'000);
    for (std::int64_t seed = 1; seed <= count; ++seed) declaration.seeds.push_back(static_cast<Seed>(seed));
    return;
  }
  for (const toml::node& node : filled_array(fits, "seeds")) {
    const auto seed = node.value_exact<std::int64_t>();
    if (!seed || *seed < 0) fits.fail("seeds", "whole numbers from 0");
    declaration.seeds.push_back(static_cast<Seed>(*seed));
  }
  expect_distinct_texts(fits, "seeds", declaration.seeds);
}

View parse_angles(const TomlSection& section, std::string_view key, const std::string& text) {
  constexpr std::string_view kNoFile = "-:";
  try {
    return parse_view(std::string(kNoFile) + text).view;
  } catch (const FieldError& error) {
    const bool is_no_view = error.complaint.find(kNoFile) != std::string::npos;
    throw_input_error(
        "{}: {}", location(section, key),
        is_no_view ? fmt::format("got '{}', expected AZIMUTH,ELEVATION in degrees", text) : error.complaint);
  }
}

std::string find_model(const TomlSection& section, const std::string& name) {
  std::error_code error;
  if (!name.ends_with(".lsys")) return name;
  const std::string found = beside_the_file(section, name);
  return fs::is_regular_file(found, error) ? fs::absolute(found).string() : name;
}

std::string find_lsystem(const TomlSection& section, std::string_view key, const std::string& name) {
  std::string file = name;
  if (!file.ends_with(".lsys")) file += ".lsys";
  std::string found = find_model(section, file);
  located(section, key, [&] { return &model_by_name(found); });
  return found;
}

SpaceDeclaration usual_space(const TomlSection& fits, const FitRecord& shared) {
  const toml::value<std::string> name("default");
  return read_space(fits, Element(fits, "spaces", name, "label"), shared);
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
void read_groups_of_targets(const TomlSection& fits, FitsDeclaration& declaration) {
  declaration.groups = groups_in(fits);
  std::vector<std::string> known = bundled_targets();
  for (const TargetDeclaration& target : declaration.targets) known.push_back(target.name);
  std::sort(known.begin(), known.end());
  for (const auto& [group, members] : declaration.groups)
    for (const std::string& member : members)
      if (!std::binary_search(known.begin(), known.end(), member))
        throw_input_error("{}: got '{}' in group '{}', expected a target like '{}'", location(fits, "groups"),
                          member, group, closest_name(member, known));
}

}  // namespace espalier
