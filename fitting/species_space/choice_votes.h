// The choices of a plant at a point of the species space: leaf shape, how many levels, children in a fan or
// along the stem. There is nothing between two of them, so the species vote: each counts by the inverse of
// its squared distance (Shepard 1968, "A two-dimensional interpolation function for irregularly-spaced
// data"), and a species at the very point decides alone.
#pragma once
#include <vector>

#include <espalier/fitting/species_space/species_space.h>

namespace espalier {

/// One weight a species, their sum 1. A demonstration has none, unless there is nothing else.
std::vector<double> vote_weights(const SpeciesSpace& space, const Eigen::VectorXd& coordinates);

/// One value a choice of the encoding: the one with the most weight among the species to which its row means
/// something; of equals the smallest.
std::vector<double> voted_choices(const SpeciesSpace& space, const Eigen::VectorXd& coordinates);

}  // namespace espalier
