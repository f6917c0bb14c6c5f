// How deep a text of TOML nests, looked at before it is parsed: toml++ 3.3 reads and frees what is nested by
// recursion, so that a key of 31,000 parts (62 kB) would overflow the stack.
#pragma once
#include <optional>
#include <string_view>

namespace espalier {

/// Levels of tables and arrays, of dotted keys and of values together.
inline constexpr long kMaxTomlDepth = 100;

/// The line, from 1, on which the text nests deeper than kMaxTomlDepth; none where it does nowhere before its
/// first error of syntax.
std::optional<long> line_of_too_deep_toml(std::string_view text);

}  // namespace espalier
