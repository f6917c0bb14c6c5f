// What `--start` says, as a value:
//   auto           each bundled preset of the model; "auto,-acer,-apple" leaves these two out
//   defaults       those of the parameter table
//   random:8       eight draws from the ranges of a search; "random" is one
//   acer,my.toml   presets by name or path
#pragma once
#include <functional>
#include <string>
#include <vector>

namespace espalier {

enum class StartSource { bundled, defaults, random, named };

struct StartNames {
  StartSource source = StartSource::bundled;
  std::vector<std::string> presets;   ///< named ones
  std::vector<std::string> left_out;  ///< of the bundled ones
  int draws = 0;                      ///< random ones
};

/// Throws FieldError ("start") where `text` is nothing of that.
StartNames parse_start(const std::string& text);

/// Whether the program chooses where to begin, and may adapt what it chooses to the picture.
bool is_automatic(const StartNames& start);

/// The text of a start with `change` done to each preset that it names.
std::string start_with(const std::string& text, const std::function<std::string(const std::string&)>& change);

/// The text of a start without a preset: it is left out of the bundled ones, or taken out of those named, of
/// which there may then be none.
std::string start_without(const std::string& text, const std::string& preset);

}  // namespace espalier
