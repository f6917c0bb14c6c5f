// [pictures]: its keys, and those of its rows and columns.
#include <fmt/ranges.h>

#include <espalier/experiments/declaration/experiment_keys.h>
#include <espalier/experiments/declaration/fit_lists.h>
#include <espalier/experiments/declaration/picture_changes.h>
#include <espalier/experiments/declaration/read_parts.h>
#include <espalier/experiments/declaration/toml_values.h>
#include <espalier/render/shading/seasons.h>

namespace espalier {

namespace {

using Declaration = PicturesDeclaration;

constexpr double kMostPictures = 10'000;  ///< of one sheet; each tree is looked at as the file is read

ExperimentKey<Declaration> changes_key(const std::string& key,
                                       std::vector<PictureChange> Declaration::*member) {
  const auto label = [](const PictureChange& change) { return change.label; };
  const auto words = [](const PictureChange& change) { return describe(change); };
  return {{key, "tables of changes", "", fmt::format("{} of the sheet", key)},
          [=](const TomlSection& pictures, Declaration& declaration) {
            declaration.*member = read_changes(pictures, key, declaration);
          },
          [=](const Declaration& was, const Declaration& is) {
            return lost_or_changed(was.*member, is.*member, label, words);
          }};
}

/// The keys that say which tree is drawn where nothing is changed.
std::vector<ExperimentKey<Declaration>> keys_of_the_tree() {
  return {
      {{"species", "a preset", "", "whose trees are drawn; this or `model` must be given"},
       [](const TomlSection& pictures, Declaration& declaration) {
         declaration.species = find_species(pictures, pictures.text("species"));
         located(pictures, "species", [&] { return load_preset(declaration.species); });
       },
       unchanged<Declaration>([](const Declaration& declaration) { return declaration.species; })},
      {{"model", "an L-system, a file or a bundled one", "", "whose trees are drawn instead"},
       [](const TomlSection& pictures, Declaration& declaration) {
         declaration.model = find_lsystem(pictures, "model", pictures.text("model"));
         if (pictures.has("species")) pictures.fail("model", "none beside a species");
       },
       unchanged<Declaration>([](const Declaration& declaration) { return declaration.model; })},
      changes_key("rows", &Declaration::rows),
      changes_key("columns", &Declaration::columns),
      {{"seed", "a whole number", fmt::format("{}", Declaration{}.seed), "of all trees"},
       [](const TomlSection& pictures, Declaration& declaration) {
         declaration.seed = static_cast<Seed>(whole_between(pictures, "seed", 0, 1'000'000'000));
       },
       unchanged<Declaration>([](const Declaration& declaration) { return declaration.seed; })},
  };
}

/// The keys that say how it is seen.
std::vector<ExperimentKey<Declaration>> keys_of_the_view() {
  return {
      {{"size", "a whole number 16..4096 (px)", fmt::format("{}", Declaration{}.size_px),
        "side of a picture"},
       [](const TomlSection& pictures, Declaration& declaration) {
         declaration.size_px = static_cast<int>(whole_between(pictures, "size", 16, 4096));
       },
       unchanged<Declaration>([](const Declaration& declaration) { return declaration.size_px; })},
      {{"frame_m", "a number above 0 (m)", "", "height of the frame (default: that of each tree)"},
       [](const TomlSection& pictures, Declaration& declaration) {
         declaration.frame_m = positive(pictures, "frame_m");
       },
       unchanged<Declaration>([](const Declaration& declaration) { return declaration.frame_m; })},
      {{"view", "AZIMUTH,ELEVATION[,FIELD_OF_VIEW], degrees", "'0,0'", "where pictures are taken from"},
       [](const TomlSection& pictures, Declaration& declaration) {
         declaration.view = parse_angles(pictures, "view", pictures.text("view"));
       },
       unchanged<Declaration>([](const Declaration& declaration) { return describe(declaration.view); })},
      {{"ground", "true or false", "false", "a lawn; it is seen from above only"},
       [](const TomlSection& pictures, Declaration& declaration) {
         declaration.ground = pictures.flag("ground");
       },
       unchanged<Declaration>([](const Declaration& declaration) { return declaration.ground; })},
      {{"objects", "meshes, as `--object`", "", "that stand beside the tree in all pictures"},
       [](const TomlSection& pictures, Declaration& declaration) {
         declaration.objects = read_objects(pictures, "objects");
       },
       unchanged<Declaration>([](const Declaration& declaration) {
         return fmt::format("[{}]", fmt::join(declaration.objects, ", "));
       })},
  };
}

std::vector<ExperimentKey<Declaration>> all_keys_of_pictures() {
  std::vector<ExperimentKey<Declaration>> keys = keys_of_the_tree();
  for (auto& key : keys_of_the_view()) keys.push_back(key);
  return keys;
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
      {"model", "an L-system, a file or a bundled one", "that of the sheet", "another one"},
      {"blend_with", "a preset", "", "on the way to which the tree lies"},
      {"t", "a number 0..1", fmt::format("{:g}", PictureChange{}.t), "how far"},
      {"set", "a table of parameters and values", "", "changed"},
      {"prune_to", "a volume, as `--prune-to`", "", "which stems do not leave"},
      {"objects", "meshes, as `--object`", "", "that stand beside the tree, too"},
      {"season", fmt::format("{}", fmt::join(season_names(), ", ")), "as the tree grows",
       "of the picture: coloured leaves, none, or young ones"},
      {"view", "AZIMUTH,ELEVATION[,FIELD_OF_VIEW], degrees", "that of the sheet",
       "where the picture is taken from"},
  };
  return keys;
}

PicturesDeclaration read_pictures(const TomlSection& pictures) {
  pictures.expect_only(names_of(pictures_keys()));
  if (!pictures.has("model") && !pictures.has("species"))
    throw_input_error("{}: species: got nothing, expected a preset, or an L-system as model",
                      toml_location(pictures.source, pictures.table));
  PicturesDeclaration declaration;
  read_keys(pictures, pictures_keys(), declaration);
  check_combinations(pictures, {declaration.rows.size(), declaration.columns.size()}, kMostPictures);
  check_together(pictures, declaration);
  return declaration;
}

}  // namespace espalier
