#include <charconv>
#include <cmath>

#include <espalier/core/assignment.h>
#include <espalier/core/error.h>

namespace espalier {

namespace {

std::optional<double> choice_value(const ParameterInfo& row, const std::string& name) {
  for (std::size_t i = 0; i < row.choices.size(); ++i)
    if (row.choices[i] == name) return row.first_choice + static_cast<double>(i);
  return std::nullopt;
}

}  // namespace

Assignment parse_assignment(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) throw_input_error("got '{}', expected name=value", text);
  return {text.substr(0, equals), text.substr(equals + 1)};
}

std::optional<double> parse_decimal(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

double parse_parameter_value(const ParameterInfo& row, const std::string& text) {
  auto value = choice_value(row, text);
  if (!value) value = parse_decimal(text);
  if (!value || !is_valid_value(row, *value))
    throw_input_error("got '{}' for {}, expected {}", text, row.full_name(), describe_valid_values(row));
  return *value + 0.0;  // never -0
}

}  // namespace espalier
