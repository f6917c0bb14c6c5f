#include <cmath>

#include <espalier/experiments/declaration/toml_values.h>

namespace espalier {

std::string location(const TomlSection& section, std::string_view key) {
  return fmt::format("{}: {}", toml_location(section.source, section.node(key)), key);
}

void check_combinations(const TomlSection& section, const std::vector<std::size_t>& lengths, double most) {
  double runs = 1;  // exact as far as it matters
  for (const std::size_t length : lengths) runs *= static_cast<double>(length);
  if (runs > most)
    throw_input_error("{}: got {:.10g} runs, every combination of the lists, expected at most {:.10g}",
                      toml_location(section.source, section.table), runs, most);
}

const toml::array& filled_array(const TomlSection& section, std::string_view key) {
  const toml::array& array = section.array(key);
  if (array.empty()) section.fail(key, "at least one value");
  if (array.size() > kMostValues) section.fail(key, fmt::format("at most {} values", kMostValues));
  return array;
}

std::int64_t whole_between(const TomlSection& section, std::string_view key, std::int64_t lower,
                           std::int64_t upper) {
  const std::int64_t value = section.whole(key);
  if (value < lower || value > upper) section.fail(key, fmt::format("a whole number {}..{}", lower, upper));
  return value;
}

double positive(const TomlSection& section, std::string_view key) {
  const double value = section.number(key);
  if (!(value > 0 && std::isfinite(value))) section.fail(key, "a number above 0");
  return value;
}

Element::Element(const TomlSection& parent, std::string_view key, const toml::node& node,
                 std::string_view shorthand)
    : place_(fmt::format("{}: {}", toml_location(parent.source, node), key)),
      section_{node.is_table() ? *node.as_table() : table_, parent.source} {
  if (node.is_table()) return;
  const auto text = node.value_exact<std::string>();
  if (!text) throw_input_error("{}: got {}, expected a string or a table", place_, describe_toml(node));
  table_.insert(shorthand, *text);
}

std::string beside_the_file(const TomlSection& section, const std::string& name) {
  const std::filesystem::path beside = std::filesystem::path(section.source).parent_path() / name;
  std::error_code error;
  return std::filesystem::is_regular_file(beside, error) ? std::filesystem::absolute(beside).string() : name;
}

}  // namespace espalier
