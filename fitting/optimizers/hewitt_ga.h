// The genetic algorithm of C. Hewitt, "Procedural generation of tree models for use in computer graphics"
// (dissertation, Cambridge 2017), section 3.3.2, as written there:
//   a randomised parameter list; a population of copies in each of which one randomly chosen parameter is
//   changed by a random amount proportional to its value, with a small chance of a sign flip; the two
//   fittest merged as the basis of the next population.
// Numbers are not given there; all of them are settings. Values and signs are the objective's
// (Objective::value_of), not those of the unit box.
#pragma once
#include <span>
#include <vector>

#include <espalier/fitting/optimizers/optimizer.h>
#include <espalier/fitting/optimizers/random_stream.h>

namespace espalier {

struct HewittNumbers {
  std::size_t population = 24;
  double step = 0.5;         ///< the largest change, as a share of the value
  double flip_chance = 0.1;  ///< of a sign flip, per child
  double zero_step = 0;      ///< the largest change of a parameter that is 0, as a share of the box
  bool elitist = false;      ///< parents change only where the best child beats the last accepted best
  bool merge_mean = false;   ///< merge by the mean of both values instead of a coin per parameter
};

/// Changes one randomly chosen parameter of `point` (coordinates in the unit box). A sign flip happens only
/// where the bounds hold the negated value's sign; results beyond the bounds are clamped to them.
void permute_one_parameter(const Objective& objective, const HewittNumbers& numbers, RandomStream& draws,
                           std::span<double> point);

/// The parameter list merged from the fittest and the second fittest.
std::vector<double> merge_parents(const Objective& objective, const HewittNumbers& numbers,
                                  RandomStream& draws, std::span<const double> fittest,
                                  std::span<const double> second);

}  // namespace espalier
