#include <algorithm>
#include <system_error>

#include <espalier/core/error.h>
#include <espalier/core/files.h>
#include <espalier/core/text/one_line.h>
#include <espalier/core/text/utf8.h>
#include <espalier/core/toml/toml_depth.h>
#include <espalier/core/toml/toml_file.h>

namespace espalier {

namespace fs = std::filesystem;

namespace {

void check_readable(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) throw_input_error("{}: no such file", path.string());
  if (status.type() == fs::file_type::directory)
    throw_input_error("{}: got a directory, expected a TOML file", path.string());
  if (status.type() != fs::file_type::regular)
    throw_input_error("{}: {}, expected a TOML file", path.string(),
                      error ? error.message() : "got no regular file");
}

void check_text(const fs::path& path, const std::string& text) {
  if (text.empty()) throw_input_error("{}: got an empty file, expected TOML", path.string());
  if (text.size() > kMaxTomlBytes)
    throw_input_error("{}: got more than {} bytes, expected a smaller TOML file", path.string(),
                      kMaxTomlBytes);
  if (text.find('\0') != std::string::npos)
    throw_input_error("{}: got a binary file, expected TOML", path.string());
}

/// The parser's own words quote the file, which may hold anything.
std::string short_line(std::string_view text) {
  constexpr std::size_t kLongest = 200;
  return one_line(text, kLongest);
}

}  // namespace

std::string read_toml_text(const fs::path& path) {
  check_readable(path);
  std::string text = read_beginning(path, kMaxTomlBytes + 1);
  check_text(path, text);
  return text;
}

toml::table parse_toml(std::string_view text, const std::string& source) {
  if (const auto line = line_of_too_deep_toml(text))
    throw_input_error("{}:{}: got keys, tables or arrays nested more than {} deep, expected fewer levels",
                      source, *line, kMaxTomlDepth);
  try {
    return toml::parse(text, source);
  } catch (const toml::parse_error& error) {
    throw_input_error("{}:{}: got bad TOML: {}", source, error.source().begin.line,
                      short_line(error.description()));
  }
}

std::string toml_location(const std::string& source, const toml::node& node) {
  const auto line = node.source().begin.line;
  return line > 0 ? fmt::format("{}:{}", source, line) : source;
}

std::optional<double> toml_number(const toml::node& node) {
  if (!node.is_number()) return std::nullopt;
  const std::optional<double> number = node.value<double>();
  return number ? std::optional(*number + 0.0) : std::nullopt;
}

std::string describe_toml(const toml::node& node) {
  if (const auto number = node.value_exact<double>()) return fmt::format("{}", *number);
  if (const auto number = node.value_exact<std::int64_t>()) return fmt::format("{}", *number);
  if (const auto text = node.value_exact<std::string>()) return fmt::format("'{}'", short_line(*text));
  if (const auto flag = node.value_exact<bool>()) return *flag ? "true" : "false";
  if (const toml::array* array = node.as_array()) return fmt::format("an array of {}", array->size());
  return node.is_table() ? "a table" : "a date or time";
}

std::string quote_toml(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : as_utf8(text)) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      quoted += {'\\', c};
    else if (code < 0x20 || code == 0x7f)
      quoted += fmt::format("\\u{:04X}", code);
    else
      quoted += c;
  }
  return quoted + '"';
}

}  // namespace espalier
