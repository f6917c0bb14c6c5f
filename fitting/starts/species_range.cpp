#include <algorithm>
#include <cmath>

#include <espalier/fitting/starts/species_range.h>

namespace espalier {

namespace {

constexpr double kShareOfSpread = 0.5;

/// What a value in this row is divided by: the tree's size for lengths.
double size_of(const ParameterTable& table, std::size_t row, const ParameterValues& values) {
  const auto scale = table.find(Role::tree_scale);
  return scale && table.rows[row].unit == "m" && values[*scale] > 0 ? values[*scale] : 1;
}

double relative(const ParameterTable& table, std::size_t row, const ParameterValues& values) {
  return values[row] / size_of(table, row, values);
}

}  // namespace

bool is_tree_size(const ParameterInfo& row) {
  return row.role.role == Role::tree_scale || row.role.role == Role::tree_scale_variation;
}

std::vector<double> spread_of_species(const ParameterTable& table, std::span<const ParameterValues> species) {
  std::vector<double> spread(table.rows.size(), 0);
  const auto count = static_cast<double>(species.size());
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    if (table.rows[row].scale == Scale::choice || species.empty()) continue;
    double sum = 0, squares = 0;
    for (const ParameterValues& values : species) sum += relative(table, row, values);
    for (const ParameterValues& values : species)
      squares += std::pow(relative(table, row, values) - sum / count, 2);
    spread[row] = std::sqrt(squares / count);
  }
  return spread;
}

double reach_of_species(const ParameterTable& table, std::size_t row, const ParameterValues& species,
                        std::span<const double> spread) {
  return kShareOfSpread * spread[row] * size_of(table, row, species);
}

void keep_to_species(const ParameterTable& table, const ParameterValues& species,
                     std::span<const double> spread, SearchChoice& choice) {
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const ParameterInfo& info = table.rows[row];
    if (is_tree_size(info) || info.point >= 0) continue;  // curves are free only where asked for
    if (spread[row] <= 0) {
      choice.fixed.insert({info.full_name(), species[row]});
      continue;
    }
    const double reach = reach_of_species(table, row, species, spread);
    choice.ranges[info.full_name()] = {std::max(info.lower, species[row] - reach),
                                       std::min(info.upper, species[row] + reach)};
  }
}

}  // namespace espalier
