// The operators of the modern genetic algorithm, on coordinates in the unit box.
// Crossover: SBX (Deb, Agrawal 1995) and uniform (Syswerda 1989). Mutation: polynomial, bounded (Deb,
// "Multi-objective optimization using evolutionary algorithms", 2001), with rates that evolve with the
// individual (Baeck 1992). Niching: clearing (Petrowski 1996).
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include <espalier/fitting/optimizers/random_stream.h>

namespace espalier {

/// How an individual mutates; inherited and itself mutated.
struct MutationRates {
  double chance = 0.1;  ///< of each coordinate to change
  double eta = 20;      ///< distribution index: larger means smaller steps
};

struct Individual {
  std::vector<double> point;
  MutationRates rates;
  double value = 0;
};

/// Mixes each coordinate of a and b, keeping their mean, with spread factor beta of index eta; then folds
/// what left the box back by mirroring.
void sbx_crossover(double eta, RandomStream& draws, std::span<double> a, std::span<double> b);

/// Swaps each coordinate of a and b with chance 1/2.
void uniform_crossover(RandomStream& draws, std::span<double> a, std::span<double> b);

/// One coordinate moved by a polynomial step that never leaves [0, 1]. uniform: the draw, in [0, 1).
double polynomial_step(double coordinate, double eta, double uniform);

void polynomial_mutation(const MutationRates& rates, RandomStream& draws, std::span<double> point);

/// The geometric mean of both parents' rates, mutated log-normally and kept in their ranges:
/// chance from 1/(4n) to 1/2, eta from 2 to 200.
MutationRates inherit_rates(const MutationRates& a, const MutationRates& b, std::size_t dimension,
                            RandomStream& draws);

/// The index of the best of `size` individuals drawn with replacement; lower rank is better.
std::size_t tournament(std::span<const std::size_t> rank, std::size_t size, RandomStream& draws);

/// The rank of each individual, 0 the best. With radius > 0, an individual within that distance (root mean
/// square over the coordinates) of a better uncleared one is cleared: ranked behind all uncleared ones.
std::vector<std::size_t> ranks_with_clearing(std::span<const Individual> population, double radius);

}  // namespace espalier
