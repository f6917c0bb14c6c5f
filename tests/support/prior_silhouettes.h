// Silhouettes of plants drawn from the prior of posteriors.
#pragma once
#include <espalier/fitting/posterior/simulations/plant_simulator.h>
#include <espalier/models/models.h>

namespace espalier {

/// Of draw `i` of this seed, or of the first after it, a thousand at a time, that grows.
inline Mask silhouette_of_prior(Seed seed, std::uint64_t i) {
  static const PlantPrior prior(model_by_name("weber_penn"));
  PlantSimulator simulator(prior, 10);
  Simulation simulation;
  while (!simulator.simulate(prior.draw(child_key(root_key(seed), i)), simulation)) i += 1000;
  return simulator.silhouette();
}

}  // namespace espalier
