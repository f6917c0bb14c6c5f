// [growth]: its keys.
#include <espalier/experiments/declaration/experiment_keys.h>
#include <espalier/experiments/declaration/fit_lists.h>
#include <espalier/experiments/declaration/read_parts.h>
#include <espalier/experiments/declaration/toml_values.h>
#include <espalier/models/preset.h>

namespace espalier {

namespace {

std::string itself(const std::string& text) { return text; }
std::string label_of_grown(const GrownLsystem& lsystem) { return lsystem.label; }
std::string model_of_grown(const GrownLsystem& lsystem) { return lsystem.model; }

void read_species(const TomlSection& growth, GrowthDeclaration& declaration) {
  filled_array(growth, "species");
  declaration.species = growth.texts("species");
  for (const std::string& species : declaration.species)
    located(growth, "species", [&] { return load_preset(species); });
  expect_distinct(growth, "species", declaration.species, itself, itself);
}

/// Labels are what tells the trees of L-systems apart; a species may have the same one.
void read_models(const TomlSection& growth, GrowthDeclaration& declaration) {
  for (const toml::node& node : filled_array(growth, "models")) {
    const Element element(growth, "models", node, "model");
    const TomlSection& section = element.section();
    section.expect_only(names_of(grown_model_keys()));
    const std::string name = section.text("model");
    const std::string model =
        node.is_table() ? find_lsystem(section, "model", name) : find_lsystem(growth, "models", name);
    declaration.models.push_back(
        {section.text_or("label", std::filesystem::path(model).stem().string()), model});
  }
  expect_distinct(growth, "models", declaration.models, label_of_grown, model_of_grown);
}

std::vector<ExperimentKey<GrowthDeclaration>> all_keys_of_growth() {
  return {
      {{"species", "presets", "all that are bundled; none with `models`", "which are grown"},
       read_species,
       [](const GrowthDeclaration& was, const GrowthDeclaration& is) {
         return lost_or_changed(was.species, is.species, itself, itself);
       }},
      {{"models", "L-systems, or tables of one", "", "whose trees are grown, too"},
       read_models,
       [](const GrowthDeclaration& was, const GrowthDeclaration& is) {
         return lost_or_changed(was.models, is.models, label_of_grown, model_of_grown);
       }},
      {{"seeds", "a whole number 1..100000", fmt::format("{}", GrowthDeclaration{}.seeds), "trees of each"},
       [](const TomlSection& growth, GrowthDeclaration& declaration) {
         declaration.seeds = static_cast<int>(whole_between(growth, "seeds", 1, 100'000));
       },
       unchanged<GrowthDeclaration>([](const GrowthDeclaration& declaration) { return declaration.seeds; })},
  };
}

}  // namespace

const std::vector<ExperimentKey<GrowthDeclaration>>& growth_keys() {
  static const std::vector<ExperimentKey<GrowthDeclaration>> keys = all_keys_of_growth();
  return keys;
}

const std::vector<KeyDescription>& grown_model_keys() {
  static const std::vector<KeyDescription> keys{
      {"model", "an L-system, a file or a bundled one", "", "a string alone is this"},
      {"label", "a string", "the file's name", "the tree that it grows, in tables"},
  };
  return keys;
}

GrowthDeclaration read_growth(const TomlSection& growth) {
  growth.expect_only(names_of(growth_keys()));
  GrowthDeclaration declaration;
  if (!growth.has("models")) declaration.species = bundled_presets();
  read_keys(growth, growth_keys(), declaration);
  return declaration;
}

}  // namespace espalier
