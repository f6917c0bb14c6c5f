#include <algorithm>

#include <espalier/fitting/species_pictures/space_plant.h>
#include <espalier/fitting/starts/thinning.h>

namespace espalier {

namespace {

const SpeciesPoint& species_named(const SpeciesSpace& space, const std::string& name) {
  return *std::find_if(space.species.begin(), space.species.end(),
                       [&](const SpeciesPoint& species) { return species.name == name; });
}

}  // namespace

GrowingPlant growing_plant_at(const SpeciesSpace& space, const Eigen::VectorXd& coordinates,
                              const GrowthBudget& budget, Seed seed) {
  constexpr int kHalvings = 6;
  GrowingPlant plant{plant_at(space, coordinates), {}};
  plant.wanted = plant.values;
  const SpeciesPoint& nearest = species_named(space, plant.nearest);
  double left = 1;
  for (int i = 0; !thin_until_grown(*space.model, budget, seed, plant.values) && i <= kHalvings; ++i) {
    left = i < kHalvings ? left / 2 : 0;
    plant.values =
        left > 0 ? plant_at(space, nearest.coordinates + left * (coordinates - nearest.coordinates)).values
                 : nearest.values;
  }
  plant.moved_by = 1 - left;
  plant.thinned = plant.moved_by == 0 && plant.values != plant.wanted;
  return plant;
}

GrowthEstimate wanted_size(const SpeciesSpace& space, const GrowingPlant& plant, Seed seed) {
  Plant grown;
  if (!space.model->generate(plant.wanted, seed, {}, grown).grown) return space.model->estimate(plant.wanted);
  return {static_cast<double>(grown.stems.size()), static_cast<double>(grown.leaves.size())};
}

}  // namespace espalier
