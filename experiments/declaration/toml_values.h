// Values of an experiment's file on their way from TOML, each checked where it stands: errors name file, line
// and key, got and expected.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <espalier/core/field_error.h>
#include <espalier/core/toml/toml_section.h>

namespace espalier {

/// "study.toml:4: seeds".
std::string location(const TomlSection& section, std::string_view key);

/// What a check of another part of the program throws, with its place in front.
template <typename Check>
auto located(const std::string& place, Check check) {
  try {
    return check();
  } catch (const FieldError& error) {
    throw_input_error("{}: {}", place, error.complaint);
  } catch (const InputError& error) {
    throw_input_error("{}: {}", place, error.what());
  }
}
template <typename Check>
auto located(const TomlSection& section, std::string_view key, Check check) {
  return located(location(section, key), check);
}

/// Of one list of an experiment.
inline constexpr std::size_t kMostValues = 10'000;

/// Throws where lists of these lengths have more combinations than `most`, before these are made.
void check_combinations(const TomlSection& section, const std::vector<std::size_t>& lengths, double most);

/// Throws where the array is empty, or holds more than kMostValues.
const toml::array& filled_array(const TomlSection& section, std::string_view key);

std::int64_t whole_between(const TomlSection& section, std::string_view key, std::int64_t lower,
                           std::int64_t upper);
double positive(const TomlSection& section, std::string_view key);

/// An element of an array as a section of its own; a plain string is the value of `shorthand`.
class Element {
 public:
  Element(const TomlSection& parent, std::string_view key, const toml::node& node,
          std::string_view shorthand);
  Element(const Element&) = delete;

  const TomlSection& section() const { return section_; }
  const std::string& place() const { return place_; }  ///< for messages

 private:
  toml::table table_;
  std::string place_;
  TomlSection section_;
};

/// A file that lies beside the experiment's, as an absolute path; else `name` as it is.
std::string beside_the_file(const TomlSection& section, const std::string& name);

/// Throws where two values have one label: tables and pages would take them for one. `label(value)` is what
/// these show, `describe(value)` what stands in the file.
template <typename Value, typename Label, typename Describe>
void expect_distinct(const TomlSection& section, std::string_view key, const std::vector<Value>& values,
                     Label label, Describe describe) {
  std::map<std::decay_t<decltype(label(values.front()))>, std::size_t> first;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (const auto [same, is_new] = first.emplace(label(values[i]), i); !is_new)
      throw_input_error("{}: got {} and {}, both labelled '{}', expected another label for one of them",
                        location(section, key), describe(values[same->second]), describe(values[i]),
                        same->first);
}

}  // namespace espalier
