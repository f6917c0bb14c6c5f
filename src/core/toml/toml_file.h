// Reading TOML that people write: presets, sidecars, run records. Every failure is one clear line.
#pragma once
#include <toml++/toml.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace espalier {

/// No TOML that people write by hand is larger.
inline constexpr std::size_t kMaxTomlBytes = 1'000'000;

/// The text of a regular file of at most kMaxTomlBytes. Throws InputError where it is missing, a
/// directory, unreadable, empty, larger, or not text.
std::string read_toml_text(const std::filesystem::path& path);

/// Parses `text`; `source` names it in messages. Throws InputError "source:line: …" on bad syntax, and where
/// it nests deeper than kMaxTomlDepth [toml_depth.h].
toml::table parse_toml(std::string_view text, const std::string& source);

/// "my.toml:12", for messages about this node.
std::string toml_location(const std::string& source, const toml::node& node);

/// A number, whole or not. -0 is read as 0: it would be written as a whole number, which has no sign.
std::optional<double> toml_number(const toml::node& node);

/// A value as a message shows it: "'tree'", "2.5", "an array", "a table".
std::string describe_toml(const toml::node& node);

/// A basic string with its quotes, any character escaped where TOML demands it. Bytes that are no UTF-8, as
/// names of files may hold, are written as the four characters `\xff`.
std::string quote_toml(std::string_view text);

}  // namespace espalier
