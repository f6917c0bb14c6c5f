#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include <espalier/core/curves/parameter_curves.h>
#include <espalier/core/error.h>
#include <espalier/overrides/parameter_override.h>

namespace espalier {

namespace {

constexpr double kMostRelative = 1e6;

/// What a key stands for: curves, or rows that are in none.
struct OverriddenParts {
  std::vector<const CurveInfo*> curves;
  std::vector<std::size_t> rows;

  const ParameterInfo& first(const ParameterTable& table) const {
    return table.rows[curves.empty() ? rows[0] : curves[0]->first_row];
  }
};

/// Of a name without its level: all levels.
OverriddenParts parts_of_key(const ParameterTable& table, const std::string& key) {
  OverriddenParts parts;
  for (const CurveInfo& curve : table.curves)
    if (curve.full_name() == key || curve.name == key) parts.curves.push_back(&curve);
  if (!parts.curves.empty()) return parts;
  parts.rows = rows_of_key(table, key);
  std::erase_if(parts.rows, [&](std::size_t row) { return table.rows[row].point >= 0; });
  return parts;
}

/// What is left out of all levels, without a word: what no branch can have.
void keep_what_branches_have(const ParameterTable& table, OverriddenParts& parts) {
  std::erase_if(parts.rows, [&](std::size_t row) { return table.rows[row].deepest_branch == kNoBranch; });
  std::erase_if(parts.curves, [&](const CurveInfo* curve) {
    return table.rows[curve->first_row].deepest_branch == kNoBranch;
  });
}

void check_relation(const ParameterInfo& row, Relation relation, const std::string& where) {
  if (relation == Relation::value || row.scale != Scale::choice) return;
  throw_input_error("{}: {}: got a {}, expected a value: it is a choice", where, row.full_name(),
                    kRelations[static_cast<std::size_t>(relation)]);
}

/// Factors keep a number that cannot be negative from becoming so.
void check_relative(const ParameterInfo& row, Relation relation, double number, const std::string& where,
                    const std::string& key) {
  const double lower = relation == Relation::factor && row.lower >= 0 ? 0 : -kMostRelative;
  if (number >= lower && number <= kMostRelative) return;
  throw_input_error("{}: key '{}': got {} as {}, expected a number from {:g} to {:g}", where, key, number,
                    kRelations[static_cast<std::size_t>(relation)], lower, kMostRelative);
}

double number_of(const toml::node& node, const ParameterInfo& row, const std::string& source,
                 const std::string& key) {
  if (const auto text = node.value_exact<std::string>()) {
    const auto found = std::find(row.choices.begin(), row.choices.end(), *text);
    if (found != row.choices.end())
      return row.first_choice + static_cast<double>(found - row.choices.begin());
  } else if (const auto number = toml_number(node)) {
    return *number;
  }
  throw_input_error("{}: key '{}': got {}, expected {}", toml_location(source, node), key,
                    describe_toml(node), describe_valid_values(row));
}

std::vector<double> numbers_of(const toml::node& node, const ParameterInfo& row, const std::string& source,
                               const std::string& key) {
  std::vector<double> numbers;
  if (const toml::array* array = node.as_array())
    for (const toml::node& one : *array) numbers.push_back(number_of(one, row, source, key));
  else
    numbers.push_back(number_of(node, row, source, key));
  return numbers;
}

/// The numbers of a curve, and where it is relative, of the curve of factors or offsets.
void add_curve(const ParameterTable& table, const CurveInfo& curve, const std::string& where,
               ParameterOverride& entry) {
  ParameterValues values(table.rows.size());
  if (entry.relation == Relation::value) {
    set_curve(table, curve, entry.numbers, where, values);
  } else {
    for (const double number : entry.numbers)
      check_relative(table.rows[curve.first_row], entry.relation, number, where, entry.key);
    Curve refined;
    try {
      refined = make_curve(entry.numbers);
    } catch (const InputError& error) {
      throw_input_error("{}: key '{}': {}", where, entry.key, error.what());
    }
    std::copy(refined.numbers.begin(), refined.numbers.end(),
              values.begin() + static_cast<std::ptrdiff_t>(curve.first_row));
  }
  for (std::size_t i = curve.first_row; i < curve.first_row + kCurveRows; ++i)
    entry.rows.push_back({static_cast<std::uint32_t>(i), values[i]});
}

/// One number for all rows, or an array of one each.
void add_rows(const ParameterTable& table, const std::vector<std::size_t>& rows, const std::string& where,
              ParameterOverride& entry) {
  if (entry.numbers.empty() || entry.numbers.size() > rows.size() || (entry.is_list && rows.size() == 1))
    throw_input_error("{}: key '{}': got an array of {}, expected a number or at most {} of them", where,
                      entry.key, entry.numbers.size(), rows.size());
  for (std::size_t i = 0; i < (entry.is_list ? entry.numbers.size() : rows.size()); ++i) {
    const ParameterInfo& row = table.rows[rows[i]];
    const double number = entry.numbers[entry.is_list ? i : 0];
    check_relation(row, entry.relation, where);
    if (row.deepest_branch == kNoBranch) continue;
    if (entry.relation == Relation::value)
      check_value(row, number, where);
    else
      check_relative(row, entry.relation, number, where, entry.key);
    entry.rows.push_back({static_cast<std::uint32_t>(rows[i]), number});
  }
}

}  // namespace

void apply(const RowOverride& entry, RowChanges& changes) {
  const auto place = std::lower_bound(changes.begin(), changes.end(), entry.row,
                                      [](const RowChange& a, std::uint32_t row) { return a.row < row; });
  const ModificationOf<double> own = modification(entry.relation, entry.number);
  if (place != changes.end() && place->row == entry.row)
    place->change = combined(place->change, own);
  else
    changes.insert(place, {entry.row, own});
}

ParameterValues changed_values(const ParameterTable& table, std::span<const double> values,
                               const RowChanges& changes) {
  ParameterValues result(values.begin(), values.end());
  for (const RowChange& each : changes)
    result[each.row] = nearest_valid_value(table.rows[each.row], each.change.apply(result[each.row]));
  return result;
}

SaidInToml read_said(const TomlSection& node, const std::string& key) {
  if (!node.node(key).is_table()) return {Relation::value, &node.node(key)};
  const TomlSection entry = node.section(key);
  entry.expect_only({"value", "factor", "offset", "private"});
  SaidInToml said;
  int found = 0;
  for (std::size_t i = 0; i < std::size(kRelations); ++i) {
    if (!entry.has(kRelations[i])) continue;
    said.relation = static_cast<Relation>(i);
    said.number = &entry.node(kRelations[i]);
    ++found;
  }
  if (entry.has("private")) said.is_private = entry.flag("private");
  if (found != 1)
    throw_input_error("{}: got {} of value, factor and offset, expected one",
                      toml_location(entry.source, entry.table), found);
  return said;
}

std::vector<std::string> parameter_keys(const ParameterTable& table) {
  std::vector<std::string> keys;
  const auto add = [&](const std::string& name, const std::string& full_name) {
    if (std::find(keys.begin(), keys.end(), name) == keys.end()) keys.push_back(name);
    if (full_name != name) keys.push_back(full_name);
  };
  for (const ParameterInfo& row : table.rows)
    if (row.point < 0) add(row.name, row.full_name());
  for (const CurveInfo& curve : table.curves) add(curve.name, curve.full_name());
  for (const ParameterInfo& row : table.rows)  // vectors, by their components
    if (row.name.ends_with("_x"))
      if (const std::string vector = row.name.substr(0, row.name.size() - 2);
          !rows_of_key(table, vector).empty())
        add(vector, vector);
  return keys;
}

ParameterOverride read_parameter(const TomlSection& node, const std::string& key,
                                 const ParameterTable& table) {
  const SaidInToml said = read_said(node, key);
  const std::string where = toml_location(node.source, node.node(key));
  OverriddenParts parts = parts_of_key(table, key);
  const ParameterInfo& first = parts.first(table);
  ParameterOverride entry{.key = key,
                          .relation = said.relation,
                          .numbers = numbers_of(*said.number, first, node.source, key),
                          .is_list = said.number->is_array(),
                          .is_private = said.is_private};
  for (const CurveInfo* curve : parts.curves) add_curve(table, *curve, where, entry);
  if (!parts.rows.empty()) add_rows(table, parts.rows, where, entry);
  keep_what_branches_have(table, parts);
  if (parts.curves.empty() && parts.rows.empty())
    throw_input_error("{}: key '{}': got one for a branch, expected none: a plant of {} has it as a whole",
                      where, key, table.model);
  return entry;
}

void check_level(const ParameterOverride& entry, int level, const ParameterTable& table,
                 const std::string& where) {
  int deepest = kNoBranch;
  for (const RowNumber& each : entry.rows) deepest = std::max(deepest, table.rows[each.row].deepest_branch);
  if (level <= deepest) return;
  throw_input_error(
      "{}: key '{}': got one for a branch of level {}, expected a level of at most {}: there it acts", where,
      entry.key, level, deepest);
}

std::string to_toml(const ParameterOverride& entry) {
  const bool is_plain = entry.key.find_first_of("[]. ") == std::string::npos;
  const std::string numbers = entry.is_list ? fmt::format("[{}]", fmt::join(entry.numbers, ", "))
                                            : fmt::format("{}", entry.numbers[0]);
  const std::string key = is_plain ? entry.key : quote_toml(entry.key);
  if (entry.relation == Relation::value && !entry.is_private) return fmt::format("{} = {}\n", key, numbers);
  return fmt::format("{} = {{ {} = {}{} }}\n", key, kRelations[static_cast<std::size_t>(entry.relation)],
                     numbers, entry.is_private ? ", private = true" : "");
}

}  // namespace espalier
