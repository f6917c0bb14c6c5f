#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <espalier/core/error.h>
#include <espalier/core/field_error.h>
#include <espalier/fitting/posterior/simulations/plant_prior.h>
#include <espalier/fitting/species_space/preset_collection.h>
#include <espalier/fitting/starts/species_range.h>

namespace espalier {

namespace {

enum Purpose : std::uint32_t { kSpecies = 0x707301, kRadius, kAngle, kSeed, kCurveRadius, kCurveAngle };

/// Standard deviation of a curve's numbers, as a share of their searched range.
constexpr double kCurveSpread = 0.2;

/// In (0, 1), 53 bits.
double open_unit(RandomKey key, std::uint32_t purpose, std::size_t index) {
  return (static_cast<double>(random_bits(key, purpose, static_cast<std::uint32_t>(index)) >> 11) + 0.5) *
         0x1p-53;
}

/// Standard normal: Box, Muller (1958).
double normal_draw(RandomKey key, std::size_t index, std::uint32_t radius = kRadius,
                   std::uint32_t angle = kAngle) {
  return std::sqrt(-2 * std::log(open_unit(key, radius, index))) *
         std::cos(2 * std::numbers::pi * open_unit(key, angle, index));
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

PlantPrior::PlantPrior(const Model& model, const PriorChoice& choice) : model_(&model) {
  const std::string& name = model.table().model;
  for (Preset& preset : bundled_species(name))
    if (!preset.demonstration) species_.push_back(std::move(preset));
  if (species_.size() < 2)
    throw_input_error("posterior: got model {} with {} bundled species, expected a model with two or more",
                      name, species_.size());
  std::vector<ParameterValues> values;
  values.reserve(species_.size());
  for (const Preset& preset : species_) values.push_back(preset.values);
  spread_ = spread_of_species(model.table(), values);
  if (!choice.species.empty()) species_ = load_presets(choice.species);
  for (const Preset& preset : species_)
    if (preset.model != name)
      throw_input_error("posterior: got {}, a preset of {}, expected one of {}", preset.name, preset.model,
                        name);
  choose_rows(choice.free);
}

void PlantPrior::choose_rows(const std::vector<std::string>& free) {
  const ParameterTable& table = model_->table();
  const auto differs = [&](std::size_t row) { return spread_[row] > 0 && !is_tree_size(table.rows[row]); };
  const SearchSpace space = make_search_space(table, species_.front().values, {.free = free});
  curves_.base = space.base;
  const auto is_named = [&](std::size_t row) {
    const std::string name = table.rows[row].full_name();
    return std::find(free.begin(), free.end(), name) != free.end();
  };
  std::set<std::size_t> rows;
  for (const FreeParameter& parameter : space.free)
    if (const CurveInfo* curve = table.curve_of(parameter.row)) {
      curves_.free.push_back(parameter);
      for (std::size_t i = 0; i < kCurveRows; ++i) rows.insert(curve->first_row + i);
    } else if (differs(parameter.row)) {
      rows.insert(parameter.row);
    } else if (is_named(parameter.row)) {
      throw_field_error("search.free", "got {}, expected a curve or a parameter in which species differ",
                        parameter.name);
    }
  if (rows.empty())
    throw_field_error("search.free", "got '{}', expected curves or parameters in which species differ",
                      fmt::join(free, ", "));
  rows_.assign(rows.begin(), rows.end());
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
  for (const std::size_t row : rows_)
    if (model_->table().curve_of(row) == nullptr)
      plant.values[row] = moved(row, values, normal_draw(key, row));
  move_curves(key, plant.values);
  return plant;
}

/// Around the species' own numbers, evenly in the searched range.
void PlantPrior::move_curves(RandomKey key, ParameterValues& values) const {
  if (curves_.dimension() == 0) return;
  std::vector<double> unit = curves_.encode(values);
  for (std::size_t i = 0; i < unit.size(); ++i)
    unit[i] = reflected(unit[i] + kCurveSpread * normal_draw(key, i, kCurveRadius, kCurveAngle), 0, 1);
  ParameterValues moved;
  curves_.decode(unit, moved);
  for (const std::size_t row : rows_)
    if (model_->table().curve_of(row) != nullptr) values[row] = moved[row];
}

}  // namespace espalier
