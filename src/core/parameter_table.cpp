#include <algorithm>
#include <cmath>
#include <iterator>

#include <espalier/core/assignment.h>
#include <espalier/core/error.h>
#include <espalier/core/near_name.h>
#include <espalier/core/parameter_table.h>

namespace espalier {

namespace {

bool is_whole(const ParameterInfo& row) {
  return row.scale == Scale::choice || (row.scale == Scale::integer && !row.relaxable);
}

std::string name_of_level(const std::string& name, int level) {
  return level < 0 ? name : fmt::format("{}[{}]", name, level);
}

std::string describe_choices(const ParameterInfo& row) {
  std::string names;
  for (const std::string& choice : row.choices) names += (names.empty() ? "" : ", ") + choice;
  return fmt::format("one of {} (or {}..{})", names, row.lower, row.upper);
}

}  // namespace

std::string ParameterInfo::full_name() const {
  const std::string whole = name_of_level(name, level);
  return point < 0 ? whole : fmt::format("{}.{}", whole, point + 1);
}

std::string CurveInfo::full_name() const { return name_of_level(name, level); }

std::optional<std::size_t> ParameterTable::find(std::string_view full_name) const {
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (full_name.starts_with(rows[i].name) && rows[i].full_name() == full_name) return i;
  return std::nullopt;
}

std::optional<std::size_t> ParameterTable::find(Role role, int level) const {
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].role == RoleOfLevel{role, level}) return i;
  return std::nullopt;
}

std::size_t ParameterTable::index_of(std::string_view full_name) const {
  if (const auto index = find(full_name)) return *index;
  if (rows.empty()) throw_input_error("got '{}', expected none: {} has no parameters", full_name, model);
  std::vector<std::string> known;
  for (const ParameterInfo& row : rows)
    if (row.point < 0) known.push_back(row.full_name());
  for (const CurveInfo& curve : curves) known.push_back(curve.full_name());
  throw_input_error("unknown parameter '{}' of model {}, closest is '{}'", full_name, model,
                    closest_name(full_name, known));
}

ParameterValues ParameterTable::defaults() const {
  ParameterValues values;
  for (const ParameterInfo& row : rows) values.push_back(row.default_value);
  return values;
}

const CurveInfo* ParameterTable::find_curve(std::string_view full_name) const {
  const auto found = std::find_if(curves.begin(), curves.end(), [&](const CurveInfo& curve) {
    return full_name.starts_with(curve.name) && curve.full_name() == full_name;
  });
  return found == curves.end() ? nullptr : &*found;
}

const CurveInfo* ParameterTable::curve_of(std::size_t row) const {
  const auto after =
      std::upper_bound(curves.begin(), curves.end(), row,
                       [](std::size_t r, const CurveInfo& curve) { return r < curve.first_row; });
  return rows[row].point < 0 || after == curves.begin() ? nullptr : &*std::prev(after);
}

bool is_neutral(const CurveInfo& curve, std::span<const double> values) {
  const auto numbers = values.subspan(curve.first_row, kCurveRows);
  return std::all_of(numbers.begin(), numbers.end(), [&](double number) { return number == curve.neutral; });
}

std::vector<bool> rows_in_use(const ParameterTable& table, std::span<const double> values) {
  ESPALIER_CHECK_EQ(values.size(), table.rows.size());
  std::vector<bool> in_use(values.size(), true);
  std::string_view part;  // that the row before is of
  bool has_part = true;
  for (std::size_t row = 0; row < values.size(); ++row) {
    const std::string& part_of = table.rows[row].part_of;
    if (part_of != part) {
      part = part_of;
      has_part = part.empty() || values[table.index_of(part)] != 0;
    }
    in_use[row] = has_part &&
                  !(table.rows[row].says_nothing_at_default && values[row] == table.rows[row].default_value);
  }
  for (const CurveInfo& curve : table.curves)
    if (is_neutral(curve, values))
      std::fill_n(in_use.begin() + static_cast<std::ptrdiff_t>(curve.first_row), kCurveRows, false);
  return in_use;
}

bool set_role(const ParameterTable& table, RoleOfLevel role, double value, ParameterValues& values) {
  const auto row = table.find(role.role, role.level);
  if (row) values[*row] = std::clamp(value, table.rows[*row].lower, table.rows[*row].upper);
  return row.has_value();
}

void scale_plant(const ParameterTable& table, double factor, ParameterValues& values) {
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (table.rows[i].unit == "m")
      values[i] = std::clamp(values[i] * factor, table.rows[i].lower, table.rows[i].upper);
}

double in_own_units(const ParameterTable& table, double length_m, const ParameterValues& values) {
  const auto unit = table.find(Role::length_unit);
  return unit ? length_m / values[*unit] : length_m;
}

std::vector<std::size_t> rows_of_key(const ParameterTable& table, std::string_view key) {
  if (const auto row = table.find(key)) return {*row};
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (table.rows[i].name == key && table.rows[i].point < 0) rows.push_back(i);
  if (!rows.empty()) return rows;
  for (const char component : {'x', 'y', 'z'}) {
    const auto row = table.find(fmt::format("{}_{}", key, component));
    if (!row) return {};
    rows.push_back(*row);
  }
  return rows;
}

double nearest_valid_value(const ParameterInfo& row, double value) {
  if (!(value > row.lower)) return row.lower;
  return std::min(is_whole(row) ? std::round(value) : value, row.upper);
}

std::string describe_valid_values(const ParameterInfo& row) {
  if (row.scale == Scale::choice && !row.choices.empty()) return describe_choices(row);
  return fmt::format("a {} {}..{}", is_whole(row) ? "whole number" : "number", row.lower, row.upper);
}

bool is_valid_value(const ParameterInfo& row, double value) {
  const bool in_bounds = std::isfinite(value) && value >= row.lower && value <= row.upper;
  return in_bounds && (!is_whole(row) || value == std::floor(value));
}

void check_value(const ParameterInfo& row, double value, std::string_view where) {
  if (is_valid_value(row, value)) return;
  throw_input_error("{}: key '{}': got {}, expected {}", where, row.full_name(), value,
                    describe_valid_values(row));
}

}  // namespace espalier
