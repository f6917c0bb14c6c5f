// Which species a plant's parameters are like, and how far it departs from them: the bundled species
// themselves lie about one standard deviation from the nearest other one (docs/species_space.md).
#pragma once
#include <string>
#include <vector>

#include <espalier/fitting/species_space/species_space.h>

namespace espalier {

struct Resemblance {
  std::string species;
  double departure = 0;  ///< root mean square over the columns that mean something to both, in standard
                         ///< deviations of the species
};

/// One for each species of the space, the nearest first. The tree's size takes no part: pictures have none.
std::vector<Resemblance> resemblances(const SpeciesSpace& space, const ParameterValues& values);

/// To the bundled species of the model; none where it has fewer than two.
std::vector<Resemblance> resemblances_to_bundled(const Model& model, const ParameterValues& values);

}  // namespace espalier
