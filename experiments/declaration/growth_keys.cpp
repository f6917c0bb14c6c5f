// [growth]: its keys.
#include <espalier/experiments/declaration/experiment_keys.h>
#include <espalier/experiments/declaration/read_parts.h>
#include <espalier/experiments/declaration/toml_values.h>
#include <espalier/models/preset.h>

namespace espalier {

namespace {

std::string itself(const std::string& text) { return text; }

void read_species(const TomlSection& growth, GrowthDeclaration& declaration) {
  filled_array(growth, "species");
  declaration.species = growth.texts("species");
  for (const std::string& species : declaration.species)
    located(growth, "species", [&] { return load_preset(species); });
  expect_distinct(growth, "species", declaration.species, itself, itself);
}

std::vector<ExperimentKey<GrowthDeclaration>> all_keys_of_growth() {
  return {
      {{"species", "presets", "all that are bundled", "which are grown"},
       read_species,
       [](const GrowthDeclaration& was, const GrowthDeclaration& is) {
         return lost_or_changed(was.species, is.species, itself, itself);
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

GrowthDeclaration read_growth(const TomlSection& growth) {
  growth.expect_only(names_of(growth_keys()));
  GrowthDeclaration declaration;
  declaration.species = bundled_presets();
  read_keys(growth, growth_keys(), declaration);
  return declaration;
}

}  // namespace espalier
