#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include <espalier/core/error.h>
#include <espalier/fitting/species_space/choice_votes.h>
#include <espalier/fitting/species_space/convex_hull.h>
#include <espalier/fitting/species_space/species_space.h>
#include <espalier/models/models.h>

namespace espalier {

namespace {

using Eigen::Index;
using GapRow = Eigen::Array<bool, Eigen::Dynamic, 1>;

constexpr double kMargin = 0.25;  ///< beyond the species' range, as a share of it

const Model& common_model(std::span<const Preset> presets) {
  if (presets.size() < 2) throw_input_error("presets: got {}, expected at least 2", presets.size());
  for (const Preset& preset : presets)
    if (preset.model != presets[0].model)
      throw_input_error("presets: got {} of model {} and {} of model {}, expected one model", presets[0].name,
                        presets[0].model, preset.name, preset.model);
  return model_by_name(presets[0].model);
}

/// That say something of one plant or another.
std::vector<bool> rows_of(const ParameterTable& table, std::span<const Preset> presets) {
  std::vector<bool> any(table.rows.size(), false);
  for (const Preset& preset : presets) {
    const std::vector<bool> in_use = rows_in_use(table, preset.values);
    for (std::size_t row = 0; row < any.size(); ++row) any[row] = any[row] || in_use[row];
  }
  return any;
}

Eigen::VectorXd vector_of(const std::vector<double>& numbers) {
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Index>(numbers.size()));
}

GapRow gaps_of(const EncodedValues& encoded) {
  GapRow means(static_cast<Index>(encoded.means.size()));
  for (std::size_t i = 0; i < encoded.means.size(); ++i) means[static_cast<Index>(i)] = encoded.means[i] != 0;
  return means;
}

Eigen::VectorXd standard_row(const SpeciesSpace& space, const EncodedValues& encoded) {
  return standardised(space.pca, vector_of(encoded.numbers), gaps_of(encoded));
}

std::size_t nearest_species(const SpeciesSpace& space, const Eigen::VectorXd& coordinates) {
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < space.species.size(); ++i)
    if ((space.species[i].coordinates - coordinates).squaredNorm() <
        (space.species[nearest].coordinates - coordinates).squaredNorm())
      nearest = i;
  return nearest;
}

/// The range of each number over the species to which it means something; empty ranges: that of the mean.
std::pair<Eigen::VectorXd, Eigen::VectorXd> column_ranges(const SpeciesSpace& space) {
  Eigen::VectorXd lower = space.pca.mean, upper = space.pca.mean;
  for (const SpeciesPoint& species : space.species) {
    const EncodedValues encoded = space.encoding->encode(species.values);
    for (Index i = 0; i < lower.size(); ++i) {
      if (!encoded.means[static_cast<std::size_t>(i)]) continue;
      lower[i] = std::min(lower[i], encoded.numbers[static_cast<std::size_t>(i)]);
      upper[i] = std::max(upper[i], encoded.numbers[static_cast<std::size_t>(i)]);
    }
  }
  const Eigen::VectorXd margin = kMargin * (upper - lower);
  return {lower - margin, upper + margin};
}

/// The values of `numbers`, moved into the species' ranges; notes what that changed, and what is not valid.
DecodedValues decode_in_range(const SpeciesSpace& space, EncodedValues encoded,
                              const Eigen::VectorXd& numbers) {
  const auto [lower, upper] = column_ranges(space);
  const Eigen::VectorXd inside = numbers.cwiseMax(lower).cwiseMin(upper);
  encoded.numbers.assign(numbers.begin(), numbers.end());
  const DecodedValues wanted = space.encoding->decode(encoded);
  encoded.numbers.assign(inside.begin(), inside.end());
  DecodedValues got = space.encoding->decode(encoded);
  for (std::size_t row = 0; row < got.values.size(); ++row)
    if (std::fabs(got.values[row] - wanted.values[row]) > 1e-9 * std::max(1.0, std::fabs(got.values[row])))
      got.clamped.push_back(
          {space.model->table().rows[row].full_name(), wanted.values[row], got.values[row]});
  return got;
}

/// Drops what means nothing to this plant, and what is named twice.
void keep_meaningful(const Encoding& encoding, const ParameterValues& values,
                     std::vector<ClampedValue>& clamped) {
  const EncodedValues encoded = encoding.encode(values);
  std::set<std::string> meaningful;
  for (std::size_t i = 0; i < encoded.means.size(); ++i)
    if (encoded.means[i]) meaningful.insert(encoding.table().rows[encoding.columns()[i].row].full_name());
  std::erase_if(clamped, [&](const ClampedValue& one) { return meaningful.erase(one.parameter) == 0; });
}

PlantAtPoint finish_plant(const SpeciesSpace& space, const Eigen::VectorXd& coordinates,
                          const std::string& nearest, DecodedValues decoded) {
  PlantAtPoint plant{std::move(decoded.values), std::move(decoded.clamped), nearest, 0};
  keep_meaningful(*space.encoding, plant.values, plant.clamped);
  Eigen::MatrixXd corners(space.dimension(), static_cast<Index>(space.species.size()));
  for (Index i = 0; i < corners.cols(); ++i)
    corners.col(i) = space.species[static_cast<std::size_t>(i)].coordinates;
  plant.outside = distance_to_hull(corners, coordinates);
  return plant;
}

}  // namespace

SpeciesSpace make_species_space(std::span<const Preset> presets, const std::string& encoding,
                                int components) {
  const Model& model = common_model(presets);
  SpeciesSpace space{&model, make_encoding(encoding, model.table(), rows_of(model.table(), presets)), {}, {}};
  const auto rows = static_cast<Index>(presets.size());
  const auto columns = static_cast<Index>(space.encoding->columns().size());
  Eigen::MatrixXd numbers(rows, columns);
  Gaps means(rows, columns);
  for (Index i = 0; i < rows; ++i) {
    const EncodedValues encoded = space.encoding->encode(presets[static_cast<std::size_t>(i)].values);
    numbers.row(i) = vector_of(encoded.numbers);
    means.row(i) = gaps_of(encoded);
  }
  space.pca = principal_components(numbers, means, components);
  for (const Preset& preset : presets)
    space.species.push_back(
        {preset.name, preset.values, coordinates_of(space, preset.values), preset.demonstration});
  return space;
}

Eigen::VectorXd coordinates_of(const SpeciesSpace& space, const ParameterValues& values) {
  return project(space.pca, standard_row(space, space.encoding->encode(values)));
}

PlantAtPoint plant_at(const SpeciesSpace& space, const Eigen::VectorXd& coordinates) {
  ESPALIER_CHECK_EQ(coordinates.size(), static_cast<Index>(space.dimension()));
  const SpeciesPoint& nearest = space.species[nearest_species(space, coordinates)];
  EncodedValues encoded = space.encoding->encode(nearest.values);
  encoded.choices = voted_choices(space, coordinates);
  return finish_plant(space, coordinates, nearest.name,
                      decode_in_range(space, std::move(encoded), reconstruct(space.pca, coordinates)));
}

PlantAtPoint plant_moved_to(const SpeciesSpace& space, const ParameterValues& values,
                            const Eigen::VectorXd& coordinates) {
  const Eigen::VectorXd move = coordinates - coordinates_of(space, values);
  const std::string& nearest = space.species[nearest_species(space, coordinates)].name;
  if (move.isZero(0)) return finish_plant(space, coordinates, nearest, {values, {}});
  const EncodedValues encoded = space.encoding->encode(values);
  const Eigen::VectorXd numbers = vector_of(encoded.numbers) + reconstruct(space.pca, move) - space.pca.mean;
  return finish_plant(space, coordinates, nearest, decode_in_range(space, encoded, numbers));
}

ReconstructionError reconstruction_error(const SpeciesSpace& space) {
  ReconstructionError error;
  const auto columns = static_cast<Index>(space.encoding->columns().size());
  Eigen::VectorXd column_squares = Eigen::VectorXd::Zero(columns), column_counts = column_squares;
  for (const SpeciesPoint& species : space.species) {
    const EncodedValues encoded = space.encoding->encode(species.values);
    const Eigen::VectorXd miss =
        standard_row(space, encoded) - space.pca.components.transpose() * species.coordinates;
    double squares = 0, count = 0;
    for (Index i = 0; i < columns; ++i) {
      if (!encoded.means[static_cast<std::size_t>(i)] || space.pca.deviation[i] == 0) continue;
      squares += miss[i] * miss[i], ++count;
      column_squares[i] += miss[i] * miss[i], ++column_counts[i];
    }
    error.of_species.push_back(count > 0 ? std::sqrt(squares / count) : 0);
  }
  for (Index i = 0; i < columns; ++i) {
    error.of_columns.push_back(column_counts[i] > 0 ? std::sqrt(column_squares[i] / column_counts[i]) : 0);
    if (space.pca.deviation[i] == 0)
      error.constant_columns.push_back(space.encoding->columns()[static_cast<std::size_t>(i)].name);
  }
  return error;
}

std::vector<Loading> strongest_loadings(const SpeciesSpace& space, std::size_t count) {
  const Eigen::VectorXd strength = space.pca.components.colwise().norm();
  std::vector<Index> order(static_cast<std::size_t>(strength.size()));
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return strength[a] > strength[b]; });
  std::vector<Loading> loadings;
  for (std::size_t i = 0; i < std::min(count, order.size()); ++i)
    loadings.push_back({space.encoding->columns()[static_cast<std::size_t>(order[i])].name,
                        space.pca.components.col(order[i])});
  return loadings;
}

}  // namespace espalier
