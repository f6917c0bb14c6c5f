#include <algorithm>
#include <cmath>

#include <espalier/fitting/species_space/preset_collection.h>
#include <espalier/fitting/species_space/resemblance.h>

namespace espalier {

namespace {

double scale_of(const ParameterTable& table, const ParameterValues& values) {
  const auto row = table.find(Role::tree_scale);
  return row && values[*row] > 0 ? values[*row] : 1;
}

double departure_of(const SpeciesSpace& space, const EncodedValues& plant, const EncodedValues& species) {
  double squares = 0, count = 0;
  for (std::size_t i = 0; i < plant.numbers.size(); ++i) {
    const double deviation = space.pca.deviation[static_cast<Eigen::Index>(i)];
    if (!plant.means[i] || !species.means[i] || deviation <= 0) continue;
    squares += std::pow((plant.numbers[i] - species.numbers[i]) / deviation, 2);
    ++count;
  }
  return count > 0 ? std::sqrt(squares / count) : 0;
}

}  // namespace

std::vector<Resemblance> resemblances(const SpeciesSpace& space, const ParameterValues& values) {
  const ParameterTable& table = space.model->table();
  std::vector<Resemblance> found;
  for (const SpeciesPoint& species : space.species) {
    ParameterValues plant = values;
    scale_plant(table, scale_of(table, species.values) / scale_of(table, values), plant);
    found.push_back({species.name, departure_of(space, space.encoding->encode(plant),
                                                space.encoding->encode(species.values))});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Resemblance& a, const Resemblance& b) { return a.departure < b.departure; });
  return found;
}

std::vector<Resemblance> resemblances_to_bundled(const Model& model, const ParameterValues& values) {
  const std::vector<Preset> presets = bundled_species(model.table().model);
  if (presets.size() < 2) return {};
  return resemblances(make_species_space(presets, "monotone", 1), values);
}

}  // namespace espalier
