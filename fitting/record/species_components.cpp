#include <charconv>
#include <string_view>

#include <espalier/core/field_error.h>
#include <espalier/fitting/record/species_components.h>

namespace espalier {

int parse_search_space(const std::string& text) {
  constexpr std::string_view kKind = "species:";
  if (text.empty()) return 0;
  int components = 0;
  const std::string_view number = text.starts_with(kKind) ? std::string_view(text).substr(kKind.size()) : "";
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), components);
  if (error != std::errc() || end != number.data() + number.size() || components < 1)
    throw_field_error("space", "got '{}', expected species:K with a number of components from 1", text);
  return components;
}

}  // namespace espalier
