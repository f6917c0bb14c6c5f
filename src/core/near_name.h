// Names that a mistyped word may have meant.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace espalier {

/// The nearest of the known names, however far it is; empty where none is known.
std::string closest_name(std::string_view word, std::span<const std::string> known);

/// The nearest of the known names where it is near: a third of the word's letters are wrong, missing, too
/// many or exchanged, or the word is the beginning of it.
std::optional<std::string> near_name(std::string_view word, std::span<const std::string> known);

}  // namespace espalier
