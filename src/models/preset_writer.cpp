// Writes a preset as TOML in the order of its model's table, a line a key with its unit and help;
// load_preset reads it back to the same bits. Numbers are the shortest decimals that do so (fmt's default).
#include <fmt/ranges.h>

#include <espalier/core/curves/parameter_curves.h>
#include <espalier/core/error.h>
#include <espalier/core/toml/toml_file.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>
#include <espalier/models/preset_reader.h>
#include <espalier/overrides/overrides_toml.h>

namespace espalier {

namespace {

std::string value_to_toml(const ParameterInfo& row, double value) {
  const double choice = value - row.first_choice;
  if (row.scale == Scale::choice && choice >= 0 && choice < static_cast<double>(row.choices.size()))
    return quote_toml(row.choices[static_cast<std::size_t>(choice)]);
  return fmt::format("{}", value);
}

/// "curve_v = [20, 50, 75, 0]", without the comment.
std::string assignment(const ParameterTable& table, const std::string& key, const ParameterValues& values) {
  const std::vector<std::size_t> rows = rows_of_key(table, key);
  std::string list;
  for (const std::size_t row : rows)
    list += (list.empty() ? "" : ", ") + value_to_toml(table.rows[row], values[row]);
  return table.rows[rows[0]].level < 0 ? fmt::format("{} = {}", key, list)
                                       : fmt::format("{} = [{}]", key, list);
}

/// "\"length_along[1]\" = [0.4, 1.1, 1.1, 0.9, 0.6, 0.4, 0.2]", without the comment.
std::string assignment(const CurveInfo& curve, const ParameterValues& values) {
  return fmt::format("{} = [{}]", quote_toml(curve.full_name()),
                     fmt::join(shortest_numbers(curve, values), ", "));
}

std::string comment(const ParameterInfo& row) {
  return row.unit.empty() || row.unit == "1" ? row.help : fmt::format("{}: {}", row.unit, row.help);
}

/// Nothing where it is not set.
std::string color_line(const char* key, PartColor color) {
  return color.is_set ? fmt::format("{} = {}\n", key, quote_toml(color_text(color))) : "";
}

}  // namespace

std::string preset_to_toml(const Preset& preset) {
  return preset_to_toml(preset, model_by_name(preset.model).table());
}

std::string preset_to_toml(const Preset& preset, const ParameterTable& table) {
  ESPALIER_CHECK_EQ(preset.values.size(), table.rows.size());
  std::string text = fmt::format("name = {}\ndescription = {}\nmodel = {}\n", quote_toml(preset.name),
                                 quote_toml(preset.description), quote_toml(preset.model));
  if (preset.seed)
    text += fmt::format("{:<36}  # of the tree that was fitted\n",
                        fmt::format("seed = {}", static_cast<std::int64_t>(*preset.seed)));
  if (preset.demonstration) text += "demonstration = true\n";
  text += color_line("bark_color", preset.colors.bark) + color_line("leaf_color", preset.colors.leaf) +
          color_line("autumn_color", preset.colors.autumn);
  text += "\n";
  const std::vector<bool> in_use = rows_in_use(table, preset.values);
  const auto is_written = [&](std::size_t i) {
    return in_use[i] || preset.values[i] != table.rows[i].default_value;
  };
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (table.rows[i].point < 0 && is_written(i) && (i == 0 || table.rows[i].name != table.rows[i - 1].name))
      text += fmt::format("{:<36}  # {}\n", assignment(table, table.rows[i].name, preset.values),
                          comment(table.rows[i]));
  for (const CurveInfo& curve : table.curves)
    if (!is_neutral(curve, preset.values))
      text += fmt::format("{:<36}  # {}\n", assignment(curve, preset.values),
                          comment(table.rows[curve.first_row]));
  return text + overrides_to_toml(preset.overrides) + grown_into_to_toml(preset.grown_into);
}

}  // namespace espalier
