// The words for an enumeration's values, in one table each: what files, the command line, tables and messages
// call them. A table is a specialisation of kNames beside its enumeration:
//   template <> inline constexpr auto kNames<Side> = std::to_array<Name<Side>>({{Side::light, "light"}, …});
#pragma once
#include <fmt/ranges.h>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <espalier/core/error.h>

namespace espalier {

template <typename Enum>
struct Name {
  Enum value;
  std::string_view name;
};

/// The table of an enumeration; without one there are no names.
template <typename Enum>
inline constexpr std::array<Name<Enum>, 0> kNames{};

template <typename Enum>
std::string name_of(Enum value) {
  for (const Name<Enum>& row : kNames<Enum>)
    if (row.value == value) return std::string(row.name);
  throw InternalError(fmt::format("value {} of an enumeration has no name", static_cast<int>(value)));
}

/// Nothing for a name that the table does not have.
template <typename Enum>
std::optional<Enum> value_named(std::string_view name) {
  for (const Name<Enum>& row : kNames<Enum>)
    if (row.name == name) return row.value;
  return std::nullopt;
}

/// In the order of the table.
template <typename Enum>
std::vector<std::string> names_of() {
  std::vector<std::string> names;
  names.reserve(kNames<Enum>.size());
  for (const Name<Enum>& row : kNames<Enum>) names.emplace_back(row.name);
  return names;
}

/// Throws InputError with all names where there is none like this.
template <typename Enum>
Enum parse_name(std::string_view name) {
  if (const auto value = value_named<Enum>(name)) return *value;
  throw_input_error("got '{}', expected {}", name, fmt::join(names_of<Enum>(), ", "));
}

}  // namespace espalier
