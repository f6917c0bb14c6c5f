#include <algorithm>
#include <array>
#include <cmath>

#include <espalier/core/assignment.h>
#include <espalier/core/curves/parameter_curves.h>
#include <espalier/core/field_error.h>
#include <espalier/core/near_name.h>
#include <espalier/fitting/record/search_space.h>

namespace espalier {

namespace {

using Range = SearchRange;

/// True where `text` matches `pattern`, in which * stands for any letters and ? for one. Where letters do not
/// match, the last * takes one more: those before it need not, so that a pattern of many takes no longer.
bool matches(std::string_view pattern, std::string_view text) {
  std::size_t at = 0, after_star = pattern.npos, taken = 0;
  for (std::size_t i = 0; i < text.size();) {
    if (at < pattern.size() && pattern[at] == '*') {
      after_star = ++at;
      taken = i;
    } else if (at < pattern.size() && (pattern[at] == '?' || pattern[at] == text[i])) {
      ++at, ++i;
    } else if (after_star != pattern.npos) {
      at = after_star;
      i = ++taken;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', at) == pattern.npos;
}

/// The end of the name must be spelt, so that patterns do not reach into curves by chance.
bool names_curve(const std::string& pattern, const ParameterInfo& row) {
  if (pattern.find(row.name.substr(row.name.rfind('_'))) == std::string::npos) return false;
  const std::string number = row.full_name(), curve = number.substr(0, number.rfind('.'));
  return matches(pattern, row.name) || matches(pattern, curve) || matches(pattern, number);
}

bool names_row(const std::string& pattern, const ParameterInfo& row) {
  if (pattern == "default") return row.free_by_default;
  if (pattern == row.name) return true;
  return row.point < 0 ? matches(pattern, row.full_name()) : names_curve(pattern, row);
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

/// A pattern of free parameters, and by how many numbers curves are searched: 0 by all that they have.
struct FreePattern {
  std::string names;
  std::size_t numbers = 0;
};

FreePattern parse_free(const std::string& text) {
  const std::size_t tilde = text.find('~');
  if (tilde == std::string::npos) return {text};
  const auto numbers = parse_decimal(text.substr(tilde + 1));
  if (!numbers || std::find(kCurveCounts.begin(), kCurveCounts.end(), *numbers) == kCurveCounts.end())
    throw_field_error("search.free", "got '{}', expected a curve, ~ and 1, 4, 5 or 7 numbers", text);
  return {text.substr(0, tilde), static_cast<std::size_t>(*numbers)};
}

/// By row: whether it is searched, and for the first row of a curve by how many numbers, if not by all.
struct ChosenRows {
  std::vector<bool> chosen;
  std::vector<std::size_t> numbers;
};

void choose(const ParameterTable& table, const std::string& text, ChosenRows& rows) {
  const FreePattern pattern = parse_free(text);
  for (const std::size_t row : rows_matching(table, pattern.names, "search.free")) {
    const CurveInfo* curve = table.curve_of(row);
    if (pattern.numbers > 0 && curve == nullptr)
      throw_field_error("search.free", "got '{}', but {} is no curve, expected a curve before ~", text,
                        table.rows[row].full_name());
    rows.chosen[row] = true;
    if (curve) rows.numbers[curve->first_row] = pattern.numbers == kCurveRows ? 0 : pattern.numbers;
  }
}

ChosenRows chosen_rows(const ParameterTable& table, const SearchChoice& choice) {
  ChosenRows rows{std::vector<bool>(table.rows.size(), false),
                  std::vector<std::size_t>(table.rows.size(), 0)};
  const std::vector<std::string> patterns =
      choice.free.empty() ? std::vector<std::string>{"default"} : choice.free;
  if (std::find(patterns.begin(), patterns.end(), "default") != patterns.end()) check_has_defaults(table);
  for (const std::string& pattern : patterns) choose(table, pattern, rows);
  for (const auto& [pattern, value] : choice.fixed)
    for (const std::size_t row : rows_matching(table, pattern, "search.fixed")) rows.chosen[row] = false;
  return rows;
}

/// A curve by `count` numbers, unless some of its own are fixed.
void add_coarse(const ParameterTable& table, const CurveInfo& curve, const ChosenRows& rows,
                const SearchChoice& choice, const ParameterValues& start, SearchSpace& space) {
  const auto first = rows.chosen.begin() + static_cast<std::ptrdiff_t>(curve.first_row);
  if (!std::all_of(first, first + kCurveRows, [](bool is_chosen) { return is_chosen; })) return;
  const std::size_t count = rows.numbers[curve.first_row];
  const std::vector<double> numbers = coarse_numbers(curve, start, count);
  for (std::size_t i = 0; i < count; ++i) {
    FreeParameter& parameter =
        space.free.emplace_back(make_free(table, curve.first_row, choice, numbers[i], 1));
    parameter.name = fmt::format("{}~{}.{}", curve.full_name(), count, i + 1);
    parameter.of_curve = count;
  }
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
  for (std::size_t i = 0; i < free.size(); i += std::max<std::size_t>(free[i].of_curve, 1))
    if (free[i].of_curve == 0)
      values[free[i].row] = value_at(free[i], unit[i]);
    else
      decode_curve(i, unit, values);
}

void SearchSpace::decode_curve(std::size_t first, std::span<const double> unit,
                               ParameterValues& values) const {
  std::array<double, kCurveNumbers> numbers{};
  const std::size_t count = free[first].of_curve;
  for (std::size_t i = 0; i < count; ++i) numbers[i] = value_at(free[first + i], unit[first + i]);
  const auto [lower, upper] =
      std::minmax_element(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(count));
  const Curve curve = make_curve(std::span(numbers).first(count));
  for (std::size_t i = 0; i < kCurveRows; ++i)
    values[free[first].row + i] = std::clamp(curve.numbers[i], *lower, *upper) + 0.0;  // valid and never -0
}

std::vector<double> SearchSpace::encode(std::span<const double> values) const {
  ESPALIER_CHECK_EQ(values.size(), base.size());
  std::vector<double> unit;
  unit.reserve(free.size());
  while (unit.size() < free.size()) {
    const FreeParameter& parameter = free[unit.size()];
    if (parameter.of_curve == 0) {
      unit.push_back(unit_at(parameter, values[parameter.row]));
      continue;
    }
    for (const double number : coarse_numbers({.first_row = parameter.row}, values, parameter.of_curve))
      unit.push_back(unit_at(free[unit.size()], number));
  }
  return unit;
}

std::vector<std::size_t> rows_matching(const ParameterTable& table, const std::string& pattern,
                                       std::string_view field) {
  std::vector<std::size_t> rows;
  std::vector<std::string> known;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (names_row(pattern, table.rows[i])) rows.push_back(i);
    if (table.rows[i].point < 0) known.push_back(table.rows[i].full_name());
  }
  for (const CurveInfo& curve : table.curves) known.push_back(curve.full_name());
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
  const ChosenRows rows = chosen_rows(table, choice);
  for (std::size_t row = 0; row < rows.chosen.size(); ++row)
    if (const CurveInfo* curve = table.curve_of(row); curve && rows.numbers[curve->first_row] > 0) {
      if (row == curve->first_row) add_coarse(table, *curve, rows, choice, start, space);
    } else if (rows.chosen[row]) {
      space.free.push_back(make_free(table, row, choice, start[row], metre_factor));
    }
  if (space.free.empty())
    throw_field_error("search.fixed", "got every free parameter, expected one left to search");
  return space;
}

}  // namespace espalier
