// One table of a TOML file, read key by key: each reader names file, line, key, got and expected where the
// value is of another kind. Readers throw InputError.
#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <espalier/core/toml/toml_file.h>

namespace espalier {

struct TomlSection {
  const toml::table& table;  ///< not owned
  std::string source;        ///< names the file in messages

  bool has(std::string_view key) const { return table.contains(key); }
  const toml::node& node(std::string_view key) const;  ///< which must be there
  /// The one message of all readers: "FILE:LINE: KEY: got …, expected …".
  [[noreturn]] void fail(std::string_view key, std::string_view expected) const;
  /// Fails for the first key that is none of these, naming the closest.
  void expect_only(const std::vector<std::string>& known) const;

  std::string text(std::string_view key) const;
  double number(std::string_view key) const;
  std::int64_t whole(std::string_view key) const;
  bool flag(std::string_view key) const;
  TomlSection section(std::string_view key) const;
  const toml::array& array(std::string_view key) const;
  /// An array of strings.
  std::vector<std::string> texts(std::string_view key) const;
  /// An array of tables: [[key]].
  std::vector<TomlSection> sections(std::string_view key) const;
  /// All keys of the table, whose values must be numbers.
  std::map<std::string, double> numbers() const;

  // The same for keys that may be missing.
  std::string text_or(std::string_view key, const std::string& otherwise) const;
  double number_or(std::string_view key, double otherwise) const;
  std::int64_t whole_or(std::string_view key, std::int64_t otherwise) const;
};

}  // namespace espalier
