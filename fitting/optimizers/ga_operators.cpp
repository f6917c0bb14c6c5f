// Selection, crossover and mutation of the modern genetic algorithm.
#include <algorithm>
#include <cmath>

#include <espalier/fitting/optimizers/ga_operators.h>
#include <espalier/fitting/optimizers/search_method.h>

namespace espalier {

void sbx_crossover(double eta, RandomStream& draws, std::span<double> a, std::span<double> b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double u = draws.uniform();
    // Deb, Agrawal (1995), eq. 9: the spread factor with density 0.5 (eta + 1) beta^eta below 1.
    const double base = u <= 0.5 ? 2 * u : 1 / (2 * (1 - u));
    const double beta = std::pow(base, 1 / (eta + 1));
    const double mean = (a[i] + b[i]) / 2;
    const double half_spread = beta * (b[i] - a[i]) / 2;
    a[i] = reflect_into_unit(mean - half_spread);
    b[i] = reflect_into_unit(mean + half_spread);
  }
}

void uniform_crossover(RandomStream& draws, std::span<double> a, std::span<double> b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (draws.chance(0.5)) std::swap(a[i], b[i]);
}

double polynomial_step(double coordinate, double eta, double uniform) {
  // Deb (2001), section 4.3, with the distance to each bound in place of the range.
  const double power = 1 / (eta + 1);
  if (uniform < 0.5) {
    const double edge = std::pow(1 - coordinate, eta + 1);
    return std::max(0.0, coordinate + std::pow(2 * uniform + (1 - 2 * uniform) * edge, power) - 1);
  }
  const double edge = std::pow(coordinate, eta + 1);
  return std::min(1.0, coordinate + 1 - std::pow(2 * (1 - uniform) + (2 * uniform - 1) * edge, power));
}

void polynomial_mutation(const MutationRates& rates, RandomStream& draws, std::span<double> point) {
  for (double& coordinate : point)
    if (draws.chance(rates.chance)) coordinate = polynomial_step(coordinate, rates.eta, draws.uniform());
}

MutationRates inherit_rates(const MutationRates& a, const MutationRates& b, std::size_t dimension,
                            RandomStream& draws) {
  constexpr double kLearningRate = 0.22;  // Baeck (1992)
  const double chance = std::sqrt(a.chance * b.chance) * std::exp(kLearningRate * draws.normal());
  const double eta = std::sqrt(a.eta * b.eta) * std::exp(kLearningRate * draws.normal());
  const double least_chance = 1 / (4 * static_cast<double>(dimension));
  return {std::clamp(chance, least_chance, 0.5), std::clamp(eta, 2.0, 200.0)};
}

std::size_t tournament(std::span<const std::size_t> rank, std::size_t size, RandomStream& draws) {
  std::size_t winner = draws.below(rank.size());
  for (std::size_t i = 1; i < size; ++i) {
    const std::size_t rival = draws.below(rank.size());
    if (rank[rival] < rank[winner]) winner = rival;
  }
  return winner;
}

namespace {

bool is_within(const std::vector<double>& a, const std::vector<double>& b, double radius) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum < radius * radius * static_cast<double>(a.size());
}

}  // namespace

std::vector<std::size_t> ranks_with_clearing(std::span<const Individual> population, double radius) {
  std::vector<double> values;
  for (const Individual& individual : population) values.push_back(individual.value);
  std::vector<std::size_t> winners, cleared;
  for (std::size_t i : ranked(values)) {
    const bool is_cleared =
        radius > 0 && std::any_of(winners.begin(), winners.end(), [&](std::size_t winner) {
          return is_within(population[i].point, population[winner].point, radius);
        });
    (is_cleared ? cleared : winners).push_back(i);
  }
  winners.insert(winners.end(), cleared.begin(), cleared.end());
  std::vector<std::size_t> rank(population.size());
  for (std::size_t place = 0; place < winners.size(); ++place) rank[winners[place]] = place;
  return rank;
}

}  // namespace espalier
