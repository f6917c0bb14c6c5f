#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>

#include <espalier/app/options/plain_numbers.h>
#include <espalier/core/assignment.h>

namespace espalier {

namespace {

template <typename Whole>
bool is_whole(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  Whole value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

bool is_number(std::string_view text) { return parse_decimal(text).has_value(); }

/// What CLI11 would read as a number begins with none of these, but for "nan", "inf" and "infinity".
bool is_word(std::string_view text) {
  if (text.empty() || std::isalpha(static_cast<unsigned char>(text[0])) == 0) return false;
  const std::string begin = CLI::detail::to_lower(std::string(text.substr(0, 3)));
  return begin != "nan" && begin != "inf";
}

/// CLI11 takes a 0 in front for an octal number.
std::string without_zeros(std::string_view text) {
  const std::string_view sign = text.starts_with('-') ? "-" : "";
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  while (text.size() > 1 && text[0] == '0') text.remove_prefix(1);
  return std::string(sign).append(text);
}

template <bool (*is_valid)(std::string_view)>
void demand(CLI::Option& option, const char* expected, bool is_whole_number) {
  const auto read = [=](std::string& text) -> std::string {
    if (is_word(text)) return "";
    if (!is_valid(text)) return fmt::format("got '{}', expected {}", text, expected);
    if (is_whole_number) text = without_zeros(text);
    return "";
  };
  option.transform(CLI::Validator(read, "", ""));
}

}  // namespace

void demand_plain_numbers(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    const std::string type = option->get_type_name();
    if (type.starts_with("UINT")) demand<is_whole<std::uint64_t>>(*option, "a whole number from 0", true);
    if (type.starts_with("INT")) demand<is_whole<std::int64_t>>(*option, "a whole number", true);
    if (type.starts_with("FLOAT")) demand<is_number>(*option, "a number", false);
  }
  for (CLI::App* command : app.get_subcommands({})) demand_plain_numbers(*command);
}

}  // namespace espalier
