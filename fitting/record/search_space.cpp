#include <algorithm>
#include <cmath>

#include <espalier/core/assignment.h>
#include <espalier/core/field_error.h>
#include <espalier/fitting/record/search_space.h>

namespace espalier {

namespace {

using Range = SearchRange;

/// True where `text` matches `pattern`, in which * stands for any letters and ? for one.
bool matches(std::string_view pattern, std::string_view text) {
  if (pattern.empty()) return text.empty();
  if (pattern[0] == '*')
    return matches(pattern.substr(1), text) || (!text.empty() && matches(pattern, text.substr(1)));
  return !text.empty() && (pattern[0] == '?' || pattern[0] == text[0]) &&
         matches(pattern.substr(1), text.substr(1));
}

bool names_row(const std::string& pattern, const ParameterInfo& row) {
  if (pattern == "default") return row.free_by_default;
  return matches(pattern, row.full_name()) || pattern == row.name;
}

double interpolate(Mapping mapping, Range range, double unit) {
  switch (mapping) {
    case Mapping::linear:
      return range.lower + unit * (range.upper - range.lower);
    case Mapping::logarithmic:
      return range.lower * std::pow(range.upper / range.lower, unit);
    case Mapping::whole:
      return std::floor(range.lower + unit * (range.upper - range.lower + 1));
  }
  throw InternalError("unknown mapping");
}

double unit_of(Mapping mapping, Range range, double value) {
  if (mapping == Mapping::whole) return (value - range.lower + 0.5) / (range.upper - range.lower + 1);
  if (!(range.upper > range.lower)) return 0.5;
  if (mapping == Mapping::logarithmic)
    return std::log(value / range.lower) / std::log(range.upper / range.lower);
  return (value - range.lower) / (range.upper - range.lower);
}

double clamp_unit(double unit) { return unit > 0 ? std::min(unit, 1.0) : 0.0; }

/// Each sign has its half of the box; whole numbers share theirs equally (-lower and upper + 1 of them).
double split_value(const FreeParameter& parameter, double unit) {
  if (unit < 0.5) {
    const double negative = parameter.lower * (1 - 2 * unit);
    return parameter.mapping == Mapping::whole ? std::floor(negative) : negative;
  }
  return interpolate(parameter.mapping, {0, parameter.upper}, 2 * unit - 1);
}

double split_unit(const FreeParameter& parameter, double value) {
  if (value >= 0) return 0.5 + 0.5 * unit_of(parameter.mapping, {0, parameter.upper}, value);
  const double middle = parameter.mapping == Mapping::whole ? 0.5 : 0;
  return 0.5 - 0.5 * (value + middle) / parameter.lower;
}

Mapping mapping_of(const ParameterInfo& row) {
  if (row.scale == Scale::logarithmic) return Mapping::logarithmic;
  const bool whole = row.scale == Scale::choice || (row.scale == Scale::integer && !row.relaxable);
  return whole ? Mapping::whole : Mapping::linear;
}

/// Where the search looks: the range of `choice`; else the table's, scaled, inside the valid values, widened
/// to hold `start`.
Range search_range(const ParameterInfo& row, const SearchChoice& choice, double start, double metre_factor) {
  if (const auto given = choice.ranges.find(row.full_name()); given != choice.ranges.end())
    return {std::max(given->second.lower, row.lower), std::min(given->second.upper, row.upper)};
  const double factor = row.unit == "m" ? metre_factor : 1;
  Range range{std::clamp(row.search_lower * factor, row.lower, row.upper),
              std::clamp(row.search_upper * factor, row.lower, row.upper)};
  if (row.scale == Scale::logarithmic && !(start > 0)) return range;  // zero has no logarithm
  return {std::min(range.lower, start), std::max(range.upper, start)};
}

FreeParameter make_free(const ParameterTable& table, std::size_t row_index, const SearchChoice& choice,
                        double start, double metre_factor) {
  const ParameterInfo& row = table.rows[row_index];
  const Range range = search_range(row, choice, start, metre_factor);
  if (row.scale == Scale::logarithmic && !(range.lower > 0))
    throw InternalError(fmt::format("{} is searched logarithmically from {}", row.full_name(), range.lower));
  return {.row = row_index,
          .name = row.full_name(),
          .mapping = mapping_of(row),
          .lower = range.lower,
          .upper = range.upper,
          .split_at_zero = row.sign == SignMeaning::flag && range.lower < 0 && range.upper > 0};
}

/// A model may have no parameter that searches vary unless told so: an L-system without `param`.
void check_has_defaults(const ParameterTable& table) {
  const auto is_default = [](const ParameterInfo& row) { return row.free_by_default; };
  if (std::any_of(table.rows.begin(), table.rows.end(), is_default)) return;
  const auto unit = table.find(Role::length_unit);
  throw_input_error(
      "{}: got a model without parameters to search, expected at least one, in an L-system a line "
      "such as 'param spread = 30 in 10 .. 60 deg'{}",
      table.model,
      unit ? fmt::format("; its size alone is searched with --free {}", table.rows[*unit].name) : "");
}

std::vector<bool> chosen_rows(const ParameterTable& table, const SearchChoice& choice) {
  std::vector<bool> chosen(table.rows.size(), false);
  const std::vector<std::string> patterns =
      choice.free.empty() ? std::vector<std::string>{"default"} : choice.free;
  if (std::find(patterns.begin(), patterns.end(), "default") != patterns.end()) check_has_defaults(table);
  for (const std::string& pattern : patterns)
    for (const std::size_t row : rows_matching(table, pattern, "search.free")) chosen[row] = true;
  for (const auto& [pattern, value] : choice.fixed)
    for (const std::size_t row : rows_matching(table, pattern, "search.fixed")) chosen[row] = false;
  return chosen;
}

}  // namespace

double value_at(const FreeParameter& parameter, double unit) {
  const double inside = clamp_unit(unit);
  const double value = parameter.split_at_zero
                           ? split_value(parameter, inside)
                           : interpolate(parameter.mapping, {parameter.lower, parameter.upper}, inside);
  return std::clamp(value, parameter.lower, parameter.upper) + 0.0;  // + 0.0: never -0
}

double unit_at(const FreeParameter& parameter, double value) {
  const double inside = std::clamp(value, parameter.lower, parameter.upper);
  return clamp_unit(parameter.split_at_zero
                        ? split_unit(parameter, inside)
                        : unit_of(parameter.mapping, {parameter.lower, parameter.upper}, inside));
}

void SearchSpace::decode(std::span<const double> unit, ParameterValues& values) const {
  ESPALIER_CHECK_EQ(unit.size(), dimension());
  values = base;
  for (std::size_t i = 0; i < free.size(); ++i) values[free[i].row] = value_at(free[i], unit[i]);
}

std::vector<double> SearchSpace::encode(std::span<const double> values) const {
  ESPALIER_CHECK_EQ(values.size(), base.size());
  std::vector<double> unit;
  for (const FreeParameter& parameter : free) unit.push_back(unit_at(parameter, values[parameter.row]));
  return unit;
}

std::vector<std::size_t> rows_matching(const ParameterTable& table, const std::string& pattern,
                                       std::string_view field) {
  std::vector<std::size_t> rows;
  std::vector<std::string> known;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (names_row(pattern, table.rows[i])) rows.push_back(i);
    known.push_back(table.rows[i].full_name());
  }
  if (rows.empty())
    throw_field_error(field, "got '{}', expected a parameter of {}; the closest is '{}'", pattern,
                      table.model, closest_name(pattern, known));
  return rows;
}

void apply_fixed(const ParameterTable& table, const SearchChoice& choice, ParameterValues& values) {
  for (const auto& [pattern, value] : choice.fixed)
    for (const std::size_t row : rows_matching(table, pattern, "search.fixed")) {
      if (!is_valid_value(table.rows[row], value))
        throw_field_error("search.fixed", "got {} for {}, expected {}", value, table.rows[row].full_name(),
                          describe_valid_values(table.rows[row]));
      values[row] = value + 0.0;  // never -0
    }
}

void keep_in_ranges(const ParameterTable& table, const SearchChoice& choice, ParameterValues& values) {
  for (const auto& [name, range] : choice.ranges)
    if (const auto row = table.find(name)) {
      const ParameterInfo& info = table.rows[*row];
      values[*row] =
          std::clamp(values[*row], std::max(range.lower, info.lower), std::min(range.upper, info.upper));
    }
}

SearchSpace make_search_space(const ParameterTable& table, const ParameterValues& start,
                              const SearchChoice& choice, double metre_factor) {
  ESPALIER_CHECK_EQ(start.size(), table.rows.size());
  SearchSpace space{start, {}};
  apply_fixed(table, choice, space.base);
  const std::vector<bool> chosen = chosen_rows(table, choice);
  for (std::size_t row = 0; row < chosen.size(); ++row)
    if (chosen[row]) space.free.push_back(make_free(table, row, choice, start[row], metre_factor));
  if (space.free.empty())
    throw_field_error("search.fixed", "got every free parameter, expected one left to search");
  return space;
}

}  // namespace espalier
