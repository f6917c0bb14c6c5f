// Writes a preset as TOML in the order of its model's table; load_preset reads it back to the same bits.
// Numbers are the shortest decimal ones that round-trip (fmt's default).
#include <cmath>

#include "core/error.h"
#include "core/toml_file.h"
#include "models/models.h"
#include "models/preset.h"
#include "models/preset_reader.h"

namespace espalier {

namespace {

std::string value_to_toml(const ParameterInfo& row, double value) {
  const auto choice = static_cast<std::size_t>(value - row.first_choice);
  if (row.scale == Scale::choice && choice < row.choices.size()) return quote_toml(row.choices[choice]);
  return fmt::format("{}", value);
}

/// "curve_v = [20, 50, 75, 0]  # deg".
std::string key_to_toml(const ParameterTable& table, const std::string& key, const ParameterValues& values) {
  std::string list;
  for (const std::size_t row : rows_of_key(table, key))
    list += (list.empty() ? "" : ", ") + value_to_toml(table.rows[row], values[row]);
  const ParameterInfo& first = table.rows[rows_of_key(table, key)[0]];
  const std::string unit = first.unit == "1" || first.unit.empty() ? "" : "  # " + first.unit;
  return first.level < 0 ? fmt::format("{} = {}{}\n", key, list, unit)
                         : fmt::format("{} = [{}]{}\n", key, list, unit);
}

}  // namespace

std::string preset_to_toml(const Preset& preset) {
  const ParameterTable& table = model_by_name(preset.model).table();
  ESPALIER_CHECK_EQ(preset.values.size(), table.rows.size());
  std::string text = fmt::format("name = {}\ndescription = {}\nmodel = {}\n\n", quote_toml(preset.name),
                                 quote_toml(preset.description), quote_toml(preset.model));
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (i == 0 || table.rows[i].name != table.rows[i - 1].name)
      text += key_to_toml(table, table.rows[i].name, preset.values);
  return text;
}

}  // namespace espalier
