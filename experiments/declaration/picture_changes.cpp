#include <fmt/ranges.h>

#include <algorithm>

#include <espalier/core/assignment.h>
#include <espalier/core/data_path.h>
#include <espalier/environment/scene_object.h>
#include <espalier/environment/volume.h>
#include <espalier/experiments/declaration/experiment_keys.h>
#include <espalier/experiments/declaration/fit_lists.h>
#include <espalier/experiments/declaration/picture_changes.h>
#include <espalier/experiments/declaration/toml_values.h>
#include <espalier/models/models.h>
#include <espalier/render/shading/seasons.h>

namespace espalier {

namespace {

/// "mesh:FILE" with the file's place; other texts as they are.
std::string with_found_mesh(const TomlSection& section, const std::string& text) {
  constexpr std::string_view kMesh = "mesh:";
  if (!text.starts_with(kMesh)) return text;
  return std::string(kMesh).append(find_data(section, text.substr(kMesh.size())));
}

void check_set(const Preset& preset, const std::string& name, double value) {
  const ParameterTable& table = model_by_name(preset.model).table();
  check_value(table.rows[table.index_of(name)], value, "parameter " + name);
}

/// What the picture shows, and of which tree.
void read_tree(const TomlSection& section, PictureChange& change) {
  change.species = find_species(section, section.text_or("species", ""));
  if (section.has("model")) change.model = find_lsystem(section, "model", section.text("model"));
  if (section.has("model") && section.has("species")) section.fail("model", "none beside a species");
  change.blend_with = section.text_or("blend_with", "");
  change.t = section.number_or("t", change.t);
  if (section.has("t") && !(change.t >= 0 && change.t <= 1)) section.fail("t", "a number 0..1");
  if (section.has("blend_with"))
    located(section, "blend_with", [&] { return load_preset(change.blend_with); });
}

void read_set(const TomlSection& section, const PicturesDeclaration& sheet, PictureChange& change) {
  const char* key = section.has("species") ? "species" : section.has("set") ? "set" : nullptr;
  if (!key) return;
  const Preset preset = located(section, key, [&] { return grown_in(sheet, change); });
  if (!section.has("set")) return;
  const TomlSection set = section.section("set");
  change.set = set.numbers();
  for (const auto& [name, value] : change.set)
    located(set, name, [&, of = name, is = value] {
      check_set(preset, of, is);
      return 0;
    });
}

void read_surroundings(const TomlSection& section, PictureChange& change) {
  change.prune_to = with_found_mesh(section, section.text_or("prune_to", ""));
  if (!change.prune_to.empty())
    located(section, "prune_to", [&] { return parse_volume(change.prune_to) != nullptr; });
  if (section.has("objects")) change.objects = read_objects(section, "objects");
  change.season = section.text_or("season", "");
  if (section.has("season"))
    located(section, "season", [&] {
      check_season(change.season);
      return 0;
    });
  if (section.has("view")) change.view = parse_angles(section, "view", section.text("view"));
}

PictureChange read_change(const TomlSection& section, const PicturesDeclaration& sheet) {
  section.expect_only(names_of(change_keys()));
  PictureChange change;
  change.label = section.text_or("label", "");
  read_tree(section, change);
  read_set(section, sheet, change);
  read_surroundings(section, change);
  return change;
}

void check_tree(const PicturesDeclaration& sheet, const PictureChange& change) {
  const Preset preset = grown_in(sheet, change);
  for (const auto& [name, value] : change.set) check_set(preset, name, value);
  if (change.blend_with.empty()) return;
  if (const Preset other = load_preset(change.blend_with); other.model != preset.model)
    throw_input_error("got a blend of {} with {}, expected trees of one model", preset.name, other.name);
}

}  // namespace

std::string find_data(const TomlSection& section, const std::string& file) {
  std::error_code error;
  if (std::filesystem::exists(file, error)) return file;
  const std::string beside = beside_the_file(section, file);
  const std::filesystem::path bundled = data_path_or_first("experiments") / file;
  return beside == file && std::filesystem::is_regular_file(bundled, error) ? bundled.string() : beside;
}

std::string find_species(const TomlSection& section, const std::string& name) {
  return name.ends_with(".toml") ? find_data(section, name) : name;
}

std::vector<PictureChange> read_changes(const TomlSection& pictures, const std::string& key,
                                        const PicturesDeclaration& sheet) {
  filled_array(pictures, key);
  std::vector<PictureChange> changes;
  for (const TomlSection& section : pictures.sections(key)) changes.push_back(read_change(section, sheet));
  expect_distinct(
      pictures, key, changes, [](const PictureChange& change) { return change.label; },
      [](const PictureChange& change) { return describe(change); });
  return changes;
}

std::string describe(const View& view) {
  return fmt::format("{},{},{},{}", view.azimuth_deg, view.elevation_deg, view.field_of_view_deg,
                     static_cast<int>(view.projection));
}

std::string describe(const PictureChange& change) {
  std::vector<std::string> parts;
  parts.reserve(change.set.size() + 6);
  for (const auto& [name, value] : change.set) parts.push_back(fmt::format("{} = {:g}", name, value));
  if (!change.species.empty()) parts.push_back("species = " + change.species);
  if (!change.model.empty()) parts.push_back("model = " + change.model);
  if (!change.blend_with.empty())
    parts.push_back(fmt::format("blend_with = {}, t = {:g}", change.blend_with, change.t));
  if (!change.prune_to.empty()) parts.push_back("prune_to = " + change.prune_to);
  if (!change.objects.empty())
    parts.push_back(fmt::format("objects = [{}]", fmt::join(change.objects, ", ")));
  if (!change.season.empty()) parts.push_back("season = " + change.season);
  if (change.view) parts.push_back("view = " + describe(*change.view));
  return fmt::format("{{{}}}", fmt::join(parts, ", "));
}

std::vector<std::string> read_objects(const TomlSection& section, std::string_view key) {
  std::vector<std::string> objects;
  SceneObjects read;
  for (const std::string& text : section.texts(key)) {
    objects.push_back(with_found_mesh(section, text));
    located(section, key, [&] {
      add_object(objects.back(), read);
      return 0;
    });
  }
  return objects;
}

PictureChange merged(const PictureChange& row, const PictureChange& column) {
  PictureChange change = row;
  for (const auto& [name, value] : column.set) change.set[name] = value;
  if (!column.species.empty() || !column.model.empty())
    change.species = column.species, change.model = column.model;
  if (!column.blend_with.empty()) change.blend_with = column.blend_with, change.t = column.t;
  if (!column.prune_to.empty()) change.prune_to = column.prune_to;
  if (!column.season.empty()) change.season = column.season;
  if (column.view) change.view = column.view;
  change.objects.insert(change.objects.end(), column.objects.begin(), column.objects.end());
  return change;
}

Preset grown_in(const PicturesDeclaration& sheet, const PictureChange& change) {
  const bool is_own = !change.species.empty() || !change.model.empty();
  const std::string& species = is_own ? change.species : sheet.species;
  const std::string& model = is_own ? change.model : sheet.model;
  if (model.empty()) return load_preset(species);
  return {std::filesystem::path(model).stem().string(), "", model, model_by_name(model).table().defaults()};
}

void check_together(const TomlSection& pictures, const PicturesDeclaration& sheet) {
  const char* key = pictures.has("columns") ? "columns" : "rows";
  if (!pictures.has(key)) return;
  for (const PictureChange& row : sheet.rows)
    for (const PictureChange& column : sheet.columns)
      located(location(pictures, key), [&] {
        check_tree(sheet, merged(row, column));
        return 0;
      });
}

}  // namespace espalier
