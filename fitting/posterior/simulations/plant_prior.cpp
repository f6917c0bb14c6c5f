#include <algorithm>
#include <cmath>
#include <numbers>

#include <espalier/core/error.h>
#include <espalier/fitting/posterior/simulations/plant_prior.h>
#include <espalier/fitting/species_space/preset_collection.h>
#include <espalier/fitting/starts/species_range.h>

namespace espalier {

namespace {

enum Purpose : std::uint32_t { kSpecies = 0x707301, kRadius, kAngle, kSeed };

/// In (0, 1), 53 bits.
double open_unit(RandomKey key, std::uint32_t purpose, std::size_t index) {
  return (static_cast<double>(random_bits(key, purpose, static_cast<std::uint32_t>(index)) >> 11) + 0.5) *
         0x1p-53;
}

/// Standard normal: Box, Muller (1958).
double normal_draw(RandomKey key, std::size_t index) {
  return std::sqrt(-2 * std::log(open_unit(key, kRadius, index))) *
         std::cos(2 * std::numbers::pi * open_unit(key, kAngle, index));
}

/// Mirrored at the ends as often as it takes.
double reflected(double value, double lower, double upper) {
  const double range = upper - lower;
  if (!(range > 0)) return lower;
  const double past = std::fmod(std::fabs(value - lower), 2 * range);
  return lower + (past <= range ? past : 2 * range - past);
}

}  // namespace

double whole_where_it_must(const ParameterInfo& row, double value) {
  return row.scale == Scale::integer && !row.relaxable ? std::round(value) : value;
}

PlantPrior::PlantPrior(const Model& model) : model_(&model) {
  for (Preset& preset : bundled_species(model.table().model))
    if (!preset.demonstration) species_.push_back(std::move(preset));
  if (species_.size() < 2)
    throw_input_error("posterior: got model {} with {} bundled species, expected a model with two or more",
                      model.table().model, species_.size());
  std::vector<ParameterValues> values;
  values.reserve(species_.size());
  for (const Preset& preset : species_) values.push_back(preset.values);
  spread_ = spread_of_species(model.table(), values);
  for (std::size_t row = 0; row < spread_.size(); ++row)
    if (const ParameterInfo& info = model.table().rows[row];
        info.free_by_default && spread_[row] > 0 && !is_tree_size(info))
      rows_.push_back(row);
}

/// A flag's sign is kept; a zero counts as positive.
double PlantPrior::moved(std::size_t row, const ParameterValues& species, double steps) const {
  const ParameterInfo& info = model_->table().rows[row];
  const double value = species[row];
  double lower = std::min(std::max(info.search_lower, info.lower), value);
  double upper = std::max(std::min(info.search_upper, info.upper), value);
  if (info.unit == "m") lower = info.lower, upper = info.upper;
  if (info.sign == SignMeaning::flag) (value >= 0 ? lower : upper) = 0;
  const double reach = reach_of_species(model_->table(), row, species, spread_);
  const double result = reflected(value + steps * reach, lower, upper);
  return std::clamp(whole_where_it_must(info, result), info.lower, info.upper) + 0.0;  // + 0.0: never -0
}

PlantDraw PlantPrior::draw(RandomKey key) const {
  PlantDraw plant;
  plant.species = static_cast<std::size_t>(random_bits(key, kSpecies) % species_.size());
  plant.seed = random_bits(key, kSeed);
  const ParameterValues& values = species_[plant.species].values;
  plant.values = values;
  for (const std::size_t row : rows_) plant.values[row] = moved(row, values, normal_draw(key, row));
  return plant;
}

}  // namespace espalier
