// [pictures]: its keys, and those of its rows and columns.
#include <fmt/ranges.h>

#include <espalier/core/assignment.h>
#include <espalier/environment/volume.h>
#include <espalier/experiments/declaration/experiment_keys.h>
#include <espalier/experiments/declaration/read_parts.h>
#include <espalier/experiments/declaration/toml_values.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>

namespace espalier {

namespace {

/// A mesh that is not found from the working directory may lie beside the experiment's file.
std::string found_volume(const TomlSection& section, const std::string& volume) {
  constexpr std::string_view kMesh = "mesh:";
  std::error_code error;
  if (!volume.starts_with(kMesh) || std::filesystem::exists(volume.substr(kMesh.size()), error))
    return volume;
  return std::string(kMesh).append(beside_the_file(section, volume.substr(kMesh.size())));
}

PictureChange read_change(const TomlSection& section, const std::string& species) {
  section.expect_only(names_of(change_keys()));
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
  change.prune_to = found_volume(section, section.text_or("prune_to", ""));
  if (!change.prune_to.empty())
    located(section, "prune_to", [&] { return parse_volume(change.prune_to) != nullptr; });
  return change;
}

std::string describe_change(const PictureChange& change) {
  std::vector<std::string> parts;
  parts.reserve(change.set.size() + 3);
  for (const auto& [name, value] : change.set) parts.push_back(fmt::format("{} = {:g}", name, value));
  if (!change.species.empty()) parts.push_back("species = " + change.species);
  if (!change.blend_with.empty())
    parts.push_back(fmt::format("blend_with = {}, t = {:g}", change.blend_with, change.t));
  if (!change.prune_to.empty()) parts.push_back("prune_to = " + change.prune_to);
  return fmt::format("{{{}}}", fmt::join(parts, ", "));
}

std::string label_of_change(const PictureChange& change) { return change.label; }

std::vector<PictureChange> read_changes(const TomlSection& pictures, const std::string& key,
                                        const std::string& species) {
  filled_array(pictures, key);
  std::vector<PictureChange> changes;
  for (const TomlSection& section : pictures.sections(key)) changes.push_back(read_change(section, species));
  expect_distinct(pictures, key, changes, label_of_change, describe_change);
  return changes;
}

ExperimentKey<PicturesDeclaration> changes_key(const std::string& key,
                                               std::vector<PictureChange> PicturesDeclaration::*member) {
  return {{key, "tables of changes", "", fmt::format("{} of the sheet", key)},
          [=](const TomlSection& pictures, PicturesDeclaration& declaration) {
            declaration.*member = read_changes(pictures, key, declaration.species);
          },
          [=](const PicturesDeclaration& was, const PicturesDeclaration& is) {
            return lost_or_changed(was.*member, is.*member, label_of_change, describe_change);
          }};
}

std::vector<ExperimentKey<PicturesDeclaration>> all_keys_of_pictures() {
  using Declaration = PicturesDeclaration;
  const Declaration usual;
  return {
      {{"species", "a preset", "", "whose trees are drawn", true},
       [](const TomlSection& pictures, Declaration& declaration) {
         declaration.species = pictures.text("species");
         located(pictures, "species", [&] { return load_preset(declaration.species); });
       },
       unchanged<Declaration>([](const Declaration& declaration) { return declaration.species; })},
      changes_key("rows", &Declaration::rows),
      changes_key("columns", &Declaration::columns),
      {{"seed", "a whole number", fmt::format("{}", usual.seed), "of all trees"},
       [](const TomlSection& pictures, Declaration& declaration) {
         declaration.seed = static_cast<Seed>(whole_between(pictures, "seed", 0, 1'000'000'000));
       },
       unchanged<Declaration>([](const Declaration& declaration) { return declaration.seed; })},
      {{"size", "a whole number 16..4096 (px)", fmt::format("{}", usual.size_px), "side of a picture"},
       [](const TomlSection& pictures, Declaration& declaration) {
         declaration.size_px = static_cast<int>(whole_between(pictures, "size", 16, 4096));
       },
       unchanged<Declaration>([](const Declaration& declaration) { return declaration.size_px; })},
      {{"frame_m", "a number above 0 (m)", "", "height of the frame (default: that of each tree)"},
       [](const TomlSection& pictures, Declaration& declaration) {
         declaration.frame_m = positive(pictures, "frame_m");
       },
       unchanged<Declaration>([](const Declaration& declaration) { return declaration.frame_m; })},
  };
}

}  // namespace

const std::vector<ExperimentKey<PicturesDeclaration>>& pictures_keys() {
  static const std::vector<ExperimentKey<PicturesDeclaration>> keys = all_keys_of_pictures();
  return keys;
}

const std::vector<KeyDescription>& change_keys() {
  static const std::vector<KeyDescription> keys{
      {"label", "a string", "''", "on the page"},
      {"species", "a preset", "that of the sheet", "another one"},
      {"blend_with", "a preset", "", "on the way to which the tree lies"},
      {"t", "a number 0..1", fmt::format("{:g}", PictureChange{}.t), "how far"},
      {"set", "a table of parameters and values", "", "changed"},
      {"prune_to", "a volume, as `--prune-to`", "", "which stems do not leave"},
  };
  return keys;
}

PicturesDeclaration read_pictures(const TomlSection& pictures) {
  pictures.expect_only(names_of(pictures_keys()));
  PicturesDeclaration declaration;
  read_keys(pictures, pictures_keys(), declaration);
  return declaration;
}

}  // namespace espalier
