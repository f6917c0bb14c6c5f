#include <algorithm>
#include <cmath>

#include <espalier/core/error.h>
#include <espalier/fitting/species_space/encoding.h>

namespace espalier {

std::unique_ptr<Encoding> make_encoding(const std::string& name, const ParameterTable& table) {
  return make_encoding(name, table, std::vector<bool>(table.rows.size(), true));
}

std::unique_ptr<Encoding> make_encoding(const std::string& name, const ParameterTable& table,
                                        const std::vector<bool>& rows) {
  ESPALIER_CHECK_EQ(rows.size(), table.rows.size());
  if (name == "raw") return make_raw_encoding(table, rows);
  if (name == "monotone") return make_monotone_encoding(table, rows);
  throw_input_error("encoding: got '{}', expected raw or monotone", name);
}

bool is_nothing(const Encoding& encoding, const EncodedValues& plant, std::size_t row) {
  if (encoding.table().rows[row].sign != SignMeaning::flag) return false;
  for (std::size_t column = 0; column < plant.numbers.size(); ++column)
    if (encoding.columns()[column].row == row && plant.numbers[column] != 0 && plant.means[column])
      return false;
  return true;
}

double valid_value(const ParameterInfo& row, double value, std::vector<ClampedValue>& clamped) {
  const double wanted = std::isnan(value) ? row.default_value : value;
  const double inside = std::clamp(wanted, row.lower, row.upper);
  const double tolerance = 1e-9 * std::max(1.0, std::fabs(inside));
  if (!(std::fabs(value - inside) <= tolerance)) clamped.push_back({row.full_name(), value, inside});
  const bool whole = row.scale == Scale::choice || (row.scale == Scale::integer && !row.relaxable);
  return (whole ? std::round(inside) : inside) + 0.0;  // + 0.0: never -0
}

}  // namespace espalier
