#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>
#include <vector>

#include <espalier/app/parameter_docs.h>

namespace espalier {

namespace {

/// Rows of the table that differ in level, default and freedom only: one line of the docs.
using RowGroup = std::vector<const ParameterInfo*>;

bool belongs_to(const RowGroup& group, const ParameterInfo& row) {
  const ParameterInfo& first = *group.front();
  return first.name == row.name && (first.point < 0) == (row.point < 0) && first.lower == row.lower &&
         first.upper == row.upper && first.search_lower == row.search_lower &&
         first.search_upper == row.search_upper && first.sign == row.sign && first.scale == row.scale;
}

std::vector<RowGroup> group_rows(const ParameterTable& table) {
  std::vector<RowGroup> groups;
  for (const ParameterInfo& row : table.rows) {
    if (groups.empty() || !belongs_to(groups.back(), row)) groups.emplace_back();
    groups.back().push_back(&row);
  }
  return groups;
}

/// "g_scale", "branches[0]", "branches[1..3]"; of curves alike.
std::string group_name(const RowGroup& group) {
  const ParameterInfo &first = *group.front(), &last = *group.back();
  if (group.size() == 1) return first.full_name();
  if (first.level < 0) return first.name;  // a curve of the whole plant
  return fmt::format("{}[{}..{}]", first.name, first.level, last.level);
}

std::string value_name(const ParameterInfo& row, double value) {
  if (row.scale != Scale::choice) return fmt::format("{}", value);
  return row.choices.at(static_cast<std::size_t>(value - row.first_choice));
}

std::string defaults_of(const RowGroup& group) {
  std::vector<std::string> values;
  if (group.front()->point >= 0)
    return value_name(*group.front(), group.front()->default_value);  // everywhere
  for (const ParameterInfo* row : group) values.push_back(value_name(*row, row->default_value));
  return fmt::format("{}", fmt::join(values, ", "));
}

/// The levels that a fit searches by default: "yes", "no", or "1, 2".
std::string free_levels(const RowGroup& group) {
  std::vector<int> levels;
  for (const ParameterInfo* row : group)
    if (row->free_by_default) levels.push_back(row->level);
  if (levels.empty()) return "no";
  return levels.size() == group.size() ? "yes" : fmt::format("{}", fmt::join(levels, ", "));
}

const char* scale_name(Scale scale) {
  constexpr const char* kNames[] = {"linear", "logarithmic", "integer", "choice"};
  return kNames[static_cast<int>(scale)];
}

std::string unit_of(const ParameterInfo& row) { return row.unit == "1" ? "" : row.unit; }

std::string help_of(const ParameterInfo& row) {
  return row.choices.empty() ? row.help : fmt::format("{}: {}", row.help, fmt::join(row.choices, ", "));
}

/// "trunk_form, branch_length[n]", n being the row's level.
std::string roles_of(const RowGroup& group) {
  std::vector<std::string> names;
  for (const ParameterInfo* row : group) {
    std::string name = role_name(row->role);
    if (goes_by_level(row->role.role)) name = name.substr(0, name.find('[')) + "[n]";
    if (!name.empty() && (names.empty() || names.back() != name)) names.push_back(name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string markdown_line(const RowGroup& group) {
  const ParameterInfo& row = *group.front();
  return fmt::format("| `{}` | {} | {} … {} | {} … {} | {} | {} | {} | {} | {} | {} |\n", group_name(group),
                     unit_of(row), row.lower, row.upper, row.search_lower, row.search_upper,
                     scale_name(row.scale), defaults_of(group), free_levels(group), row.symbol,
                     roles_of(group), help_of(row));
}

nlohmann::ordered_json row_as_json(const ParameterInfo& row) {
  nlohmann::ordered_json json = {{"name", row.name}, {"full_name", row.full_name()}};
  if (row.level >= 0) json["level"] = row.level;
  if (row.point >= 0) json["point"] = row.point + 1;
  json.update({{"unit", row.unit},
               {"lower", row.lower},
               {"upper", row.upper},
               {"search_lower", row.search_lower},
               {"search_upper", row.search_upper},
               {"scale", scale_name(row.scale)},
               {"sign_is_flag", row.sign == SignMeaning::flag},
               {"default", row.default_value},
               {"free_by_default", row.free_by_default},
               {"role", role_name(row.role)},
               {"symbol", row.symbol},
               {"help", row.help}});
  if (!row.choices.empty()) json.update({{"choices", row.choices}, {"first_choice", row.first_choice}});
  return json;
}

}  // namespace

std::string parameters_as_text(const ParameterTable& table) {
  std::string text =
      fmt::format("{:<20} {:<4} {:<16} {:<24} {}\n", "parameter", "unit", "valid", "default", "meaning");
  for (const RowGroup& group : group_rows(table)) {
    const ParameterInfo& row = *group.front();
    text += fmt::format("{:<20} {:<4} {:<16} {:<24} {}\n", group_name(group), unit_of(row),
                        fmt::format("{} .. {}", row.lower, row.upper), defaults_of(group), help_of(row));
  }
  return text;
}

namespace {

/// How a preset writes one; nothing for models without curves.
std::string curves_in_words(const ParameterTable& table) {
  if (table.curves.empty()) return "";
  return fmt::format(" A curve has 1, 4, 5 or 7 numbers at each level:\n`\"{}\" = [0.5, 1, 1, 0.2]`.",
                     table.curves.front().full_name());
}

}  // namespace

std::string parameters_as_markdown(const ParameterTable& table) {
  std::string text = fmt::format(
      "# Parameters of the model `{0}`\n\n"
      "Made by `espalier params --model {0} --format markdown`. A name with levels is an array in a preset,\n"
      "one value for each level of branching, the trunk first.{1} *Search* is where a fit looks unless told\n"
      "otherwise; *free* says which levels it changes by default, *role* what it is to a fit. Lengths in "
      "metres,\n"
      "angles in degrees.\n\n"
      "| parameter | unit | valid | search | scale | default | free | paper | role | meaning |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n",
      table.model, curves_in_words(table));
  for (const RowGroup& group : group_rows(table)) text += markdown_line(group);
  return text;
}

std::string parameters_as_json(const ParameterTable& table) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const ParameterInfo& row : table.rows) rows.push_back(row_as_json(row));
  return nlohmann::ordered_json{{"model", table.model}, {"parameters", rows}}.dump(2) + "\n";
}

}  // namespace espalier
