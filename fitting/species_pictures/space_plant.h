// A plant at a point of the species space that is sure to grow.
#pragma once
#include <espalier/core/random.h>
#include <espalier/fitting/species_space/species_space.h>

namespace espalier {

struct GrowingPlant : PlantAtPoint {
  ParameterValues wanted;  ///< at the point, before anything was taken out
  bool thinned = false;    ///< leaves or branches were taken out, to fit the budget
  double moved_by = 0;  ///< share of the way to the nearest species that the point had to go for it, 0 … 1
};

/// plant_at, thinned until the plant of this seed grows within the budget. Where thinning is not enough, the
/// point moves towards the nearest species, half the way at a time, and at last gives that species, thinned.
GrowingPlant growing_plant_at(const SpeciesSpace& space, const Eigen::VectorXd& coordinates,
                              const GrowthBudget& budget, Seed seed);

/// Stems and leaves of the plant that was wanted: as they grow or, where that is more than any plant may
/// have, as they are expected.
GrowthEstimate wanted_size(const SpeciesSpace& space, const GrowingPlant& plant, Seed seed);

}  // namespace espalier
