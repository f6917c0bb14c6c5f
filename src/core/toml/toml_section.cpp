#include <algorithm>

#include <espalier/core/error.h>
#include <espalier/core/near_name.h>
#include <espalier/core/parameter_table.h>
#include <espalier/core/toml/toml_section.h>

namespace espalier {

const toml::node& TomlSection::node(std::string_view key) const {
  if (const toml::node* found = table.get(key)) return *found;
  throw_input_error("{}: {}: got nothing, expected it here", toml_location(source, table), key);
}

void TomlSection::fail(std::string_view key, std::string_view expected) const {
  throw_input_error("{}: {}: got {}, expected {}", toml_location(source, node(key)), key,
                    describe_toml(node(key)), expected);
}

void TomlSection::expect_only(const std::vector<std::string>& known) const {
  for (const auto& [key, value] : table)
    if (std::find(known.begin(), known.end(), key.str()) == known.end())
      throw_input_error("{}: {}: got an unknown key, expected one like '{}'", toml_location(source, value),
                        key.str(), closest_name(std::string(key.str()), known));
}

std::string TomlSection::text(std::string_view key) const {
  if (const auto value = node(key).value_exact<std::string>()) return *value;
  fail(key, "a string");
}

double TomlSection::number(std::string_view key) const {
  if (const auto value = toml_number(node(key))) return *value;
  fail(key, "a number");
}

std::int64_t TomlSection::whole(std::string_view key) const {
  if (const auto value = node(key).value_exact<std::int64_t>()) return *value;
  fail(key, "a whole number");
}

bool TomlSection::flag(std::string_view key) const {
  if (const auto value = node(key).value_exact<bool>()) return *value;
  fail(key, "true or false");
}

TomlSection TomlSection::section(std::string_view key) const {
  if (const toml::table* inner = node(key).as_table()) return {*inner, source};
  fail(key, "a table");
}

const toml::array& TomlSection::array(std::string_view key) const {
  if (const toml::array* found = node(key).as_array()) return *found;
  fail(key, "an array");
}

std::vector<std::string> TomlSection::texts(std::string_view key) const {
  std::vector<std::string> all;
  for (const toml::node& element : array(key)) {
    const auto value = element.value_exact<std::string>();
    if (!value) fail(key, "an array of strings");
    all.push_back(*value);
  }
  return all;
}

std::vector<TomlSection> TomlSection::sections(std::string_view key) const {
  std::vector<TomlSection> all;
  for (const toml::node& element : array(key)) {
    const toml::table* inner = element.as_table();
    if (!inner) fail(key, "an array of tables");
    all.push_back({*inner, source});
  }
  return all;
}

std::map<std::string, double> TomlSection::numbers() const {
  std::map<std::string, double> values;
  for (const auto& [key, value] : table) values[std::string(key.str())] = number(key.str());
  return values;
}

std::string TomlSection::text_or(std::string_view key, const std::string& otherwise) const {
  return has(key) ? text(key) : otherwise;
}

double TomlSection::number_or(std::string_view key, double otherwise) const {
  return has(key) ? number(key) : otherwise;
}

std::int64_t TomlSection::whole_or(std::string_view key, std::int64_t otherwise) const {
  return has(key) ? whole(key) : otherwise;
}

}  // namespace espalier
