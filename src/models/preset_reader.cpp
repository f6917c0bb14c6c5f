#include <algorithm>
#include <optional>

#include <espalier/core/curves/parameter_curves.h>
#include <espalier/core/error.h>
#include <espalier/core/near_name.h>
#include <espalier/core/toml/toml_file.h>
#include <espalier/models/preset_reader.h>

namespace espalier {

namespace {

/// The keys a preset may hold, without doubles, in the order of the table.
std::vector<std::string> known_keys(const ParameterTable& table, std::span<const std::string> other_keys) {
  std::vector<std::string> keys(other_keys.begin(), other_keys.end());
  for (const ParameterInfo& row : table.rows)
    if (row.point < 0 && (keys.empty() || keys.back() != row.name)) keys.push_back(row.name);
  for (const CurveInfo& curve : table.curves) keys.push_back(curve.full_name());
  return keys;
}

std::optional<double> choice_by_name(const ParameterInfo& row, const toml::node& node) {
  const auto text = node.value_exact<std::string>();
  const auto found = text ? std::find(row.choices.begin(), row.choices.end(), *text) : row.choices.end();
  if (found == row.choices.end()) return std::nullopt;
  return row.first_choice + static_cast<double>(found - row.choices.begin());
}

double read_value(const ParameterInfo& row, const toml::node& node, const std::string& source) {
  if (const auto choice = choice_by_name(row, node)) return *choice;
  const std::string where = toml_location(source, node);
  const auto value = toml_number(node);
  if (!value)
    throw_input_error("{}: key '{}': got {}, expected {}", where, row.full_name(), describe_toml(node),
                      describe_valid_values(row));
  check_value(row, *value, where);
  return *value;
}

/// The numbers of a curve: one, or an array of 1, 4, 5 or 7.
void read_curve(const CurveInfo& curve, const toml::node& node, const std::string& source,
                const ParameterTable& table, ParameterValues& values) {
  const std::string where = toml_location(source, node);
  std::vector<double> numbers;
  const auto take = [&](const toml::node& one) {
    const auto value = toml_number(one);
    if (!value)
      throw_input_error("{}: key '{}': got {}, expected {}", toml_location(source, one), curve.full_name(),
                        describe_toml(one), describe_valid_values(table.rows[curve.first_row]));
    numbers.push_back(*value);
  };
  if (const toml::array* array = node.as_array())
    for (const toml::node& one : *array) take(one);
  else
    take(node);
  set_curve(table, curve, numbers, where, values);
}

void check_is_array(std::string_view key, const toml::node& node, std::size_t max_size,
                    const std::string& source) {
  const toml::array* array = node.as_array();
  if (array && array->size() <= max_size) return;
  throw_input_error("{}: key '{}': got {}, expected an array of at most {} values",
                    toml_location(source, node), key, describe_toml(node), max_size);
}

void read_key(std::string_view key, const toml::node& node, const std::string& source,
              const ParameterTable& table, const std::vector<std::size_t>& rows, ParameterValues& values) {
  if (table.find(key)) {
    values[rows[0]] = read_value(table.rows[rows[0]], node, source);
    return;
  }
  check_is_array(key, node, rows.size(), source);
  const toml::array& array = *node.as_array();
  for (std::size_t i = 0; i < array.size(); ++i)
    values[rows[i]] = read_value(table.rows[rows[i]], array[i], source);
}

}  // namespace

void read_parameters(const toml::table& document, const std::string& source, const ParameterTable& table,
                     std::span<const std::string> other_keys, ParameterValues& values) {
  for (const auto& [toml_key, node] : document) {
    const std::string key(toml_key.str());
    if (std::find(other_keys.begin(), other_keys.end(), key) != other_keys.end()) continue;
    if (const CurveInfo* curve = table.find_curve(key)) {
      read_curve(*curve, node, source, table, values);
      continue;
    }
    const std::vector<std::size_t> rows = rows_of_key(table, key);
    if (rows.empty())
      throw_input_error("{}: key '{}': got an unknown key, expected one like '{}'",
                        toml_location(source, node), key, closest_name(key, known_keys(table, other_keys)));
    read_key(key, node, source, table, rows, values);
  }
  check_densities(table, values, source);
}

}  // namespace espalier
