#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <espalier/core/error.h>
#include <espalier/fitting/species_space/choice_votes.h>

namespace espalier {

namespace {

/// Whether each species may vote.
std::vector<bool> voters_of(const SpeciesSpace& space) {
  const bool none = std::all_of(space.species.begin(), space.species.end(),
                                [](const SpeciesPoint& species) { return species.demonstration; });
  std::vector<bool> voters;
  voters.reserve(space.species.size());
  for (const SpeciesPoint& species : space.species) voters.push_back(none || !species.demonstration);
  return voters;
}

/// Of the smallest first: the same for any order of the species.
double sum_of(std::vector<double> weights) {
  std::sort(weights.begin(), weights.end());
  double sum = 0;
  for (const double weight : weights) sum += weight;
  return sum;
}

/// The value with the most weight; of equals the smallest. Nothing where nobody votes.
std::optional<double> winner_of(const std::map<double, std::vector<double>>& weights_of_values) {
  std::optional<double> winner;
  double most = 0;
  for (const auto& [value, weights] : weights_of_values) {
    const double sum = sum_of(weights);
    if (sum > most) winner = value, most = sum;
  }
  return winner;
}

}  // namespace

std::vector<double> vote_weights(const SpeciesSpace& space, const Eigen::VectorXd& coordinates) {
  ESPALIER_CHECK_EQ(coordinates.size(), static_cast<Eigen::Index>(space.dimension()));
  const std::vector<bool> votes = voters_of(space);
  std::vector<double> distances;
  distances.reserve(space.species.size());
  for (const SpeciesPoint& species : space.species)
    distances.push_back((species.coordinates - coordinates).stableNorm());
  double nearest = INFINITY;
  for (std::size_t i = 0; i < distances.size(); ++i)
    if (votes[i]) nearest = std::min(nearest, distances[i]);
  // In units of the nearest one's distance, so that no square overflows or vanishes.
  std::vector<double> weights(distances.size(), 0.0);
  for (std::size_t i = 0; i < weights.size(); ++i)
    if (votes[i] && distances[i] == nearest)
      weights[i] = 1;
    else if (votes[i] && nearest > 0)
      weights[i] = std::pow(nearest / distances[i], 2);
  const double sum = sum_of(weights);
  for (double& weight : weights) weight /= sum;
  return weights;
}

std::vector<double> voted_choices(const SpeciesSpace& space, const Eigen::VectorXd& coordinates) {
  const std::vector<double> weights = vote_weights(space, coordinates);
  std::vector<EncodedValues> encoded;
  encoded.reserve(weights.size());
  for (const SpeciesPoint& species : space.species) encoded.push_back(space.encoding->encode(species.values));
  std::vector<double> chosen;
  chosen.reserve(space.encoding->choices().size());
  for (std::size_t choice = 0; choice < space.encoding->choices().size(); ++choice) {
    std::map<double, std::vector<double>> knowing, all;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const double value = encoded[i].choices[choice];
      all[value].push_back(weights[i]);
      if (!is_nothing(*space.encoding, encoded[i], space.encoding->choices()[choice].row))
        knowing[value].push_back(weights[i]);
    }
    chosen.push_back(winner_of(knowing).value_or(*winner_of(all)));
  }
  return chosen;
}

}  // namespace espalier
