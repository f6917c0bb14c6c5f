#include <algorithm>

#include <espalier/lsystem/derivation/derivation.h>
#include <espalier/lsystem/drawing/plant_builder.h>
#include <espalier/lsystem/files/grammar_file.h>
#include <espalier/lsystem/files/grow_copied.h>
#include <espalier/lsystem/notation/parse_surroundings.h>

namespace espalier::lsystem {

namespace {

struct Planting {
  std::vector<double> values;
  Seed seed = 1;
};

Planting planting_of(const ParameterTable& table, const std::vector<NamedNumber>& numbers) {
  Planting planting{table.defaults(), 1};
  for (const NamedNumber& number : numbers) {
    const auto row = std::find_if(table.rows.begin(), table.rows.end(),
                                  [&](const ParameterInfo& info) { return info.name == number.name; });
    if (row != table.rows.end()) {
      check_value(*row, number.value, describe(number.position));
      planting.values[static_cast<std::size_t>(row - table.rows.begin())] = number.value;
    } else if (number.name == "seed" && number.value >= 0 && number.value <= 1e9) {
      planting.seed = static_cast<Seed>(number.value);
    } else {
      throw_at(number.position, "got {}={}, expected a parameter of {}, or a seed from 0 to 1e9", number.name,
               number.value, table.model);
    }
  }
  return planting;
}

std::shared_ptr<const JointedPlant> grow(const Grammar& grammar, const Planting& planting, Limits& left) {
  Derivation derivation(grammar, left);
  derivation.start(planting.values, planting.seed);
  derivation.run(derivation.settings().steps);
  Settings settings = derivation.settings();
  settings.unit_m = 1;
  auto grown = std::make_shared<JointedPlant>();
  build_plant(derivation.interpreted(), derivation.alphabet(), settings, grown->plant, derivation.work(),
              &grown->joints);
  left.work -= derivation.work().done();
  left.lua_instructions -= derivation.lua_instructions();
  return grown;
}

}  // namespace

std::shared_ptr<const JointedPlant> grow_copied(const PlantDeclaration& declaration, Limits& left) {
  const auto& [file, numbers, position] = declaration;
  std::optional<Grammar> grammar;
  try {
    if (!file.ends_with(".lsys"))
      throw_input_error("got file \"{}\", expected one that ends with .lsys", file);
    grammar = read_grammar(file_beside(file, *position.source).string(), false, position.source->so_far);
    ReadFiles& files = *position.source->files;
    files.insert(files.end(), grammar->files.begin(), grammar->files.end());
  } catch (const InputError& error) {
    throw_at(position, "{}", error.what());
  }
  const Planting planting = planting_of(grammar->parameters, numbers);
  try {
    return grow(*grammar, planting, left);
  } catch (const InputError& error) {
    throw_at(position, "plant \"{}\": {}", file, error.what());
  }
}

}  // namespace espalier::lsystem
