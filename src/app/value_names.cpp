#include <CLI/CLI.hpp>
#include <algorithm>

#include <espalier/app/value_names.h>

namespace espalier {

namespace {

constexpr ValueName kValueNames[] = {
    {"fit", "--output", "DIR", Offers::directories},
    {"posterior", "--output", "DIR", Offers::directories},
    {"run", "--output", "DIR", Offers::directories},
    {"compare", "--output", "DIR", Offers::directories},
    {"export", "--output", "DIR", Offers::directories},
    {"", "--output", "FILE", Offers::files},
    {"", "--resume", "DIR", Offers::directories},
    {"", "--repeat", "DIR", Offers::directories},
    {"", "--picture", "FILE", Offers::files},
    {"", "--views", "FILE:AZ,EL", Offers::files},
    {"target", "--labels", "FILE", Offers::files},
    {"", "--labels", "WORD", Offers::words, "auto|none"},
    {"render", "--size", "N|WxH"},
    {"mask", "--size", "N|WxH"},
    {"lsystem", "--size", "N|WxH"},
    {"", "--overlay", "FILE", Offers::files},
    {"", "--check", "FILE", Offers::files},
    {"", "--save", "FILE", Offers::files},
    {"", "--space", "FILE", Offers::files},
    {"", "--table", "FILE", Offers::files},
    {"bench", "--json", "FILE", Offers::files},
    {"bench", "--plot", "FILE", Offers::files},
    {"", "--compare", "FILE", Offers::files},
    {"", "--presets", "A,B", Offers::words, "presets"},
    {"", "--object", "mesh:FILE", Offers::files},
    {"", "--prune-to", "VOLUME", Offers::files},
    {"", "--volume", "NAME=VOLUME", Offers::files},
    {"", "--optimizer", "NAME", Offers::words, "optimizers"},
    {"", "--objective", "SUM", Offers::words, "measures"},
    {"", "--start", "NAMES", Offers::words, "starts"},
    {"", "--species", "NAME", Offers::words, "presets"},
    {"", "--model", "NAME", Offers::words, "models"},
    {"", "--kind", "WORD", Offers::words, "auto|any|leafy|leafless|palm"},
    {"", "--separation", "WORD", Offers::words, "auto|alpha|luminance|background"},
    {"", "--ground-color", "COLOR"},
    {"", "--tree-color", "COLOR"},
    {"", "--region", "X,Y,W,H"},
    {"", "--seed-tree", "X,Y"},
    {"", "--seed-ground", "X,Y"},
    {"", "--label", "N|COLOR"},
    {"", "--keep-marks", "WORDS", Offers::words, "none|all|strips|lines|captions|figures"},
    {"", "--scale-bar", "PX=METRES"},
    {"", "--sheet", "FILE", Offers::files},
    {"", "--tree-side", "WORD", Offers::words, "auto|light|dark"},
    {"", "--stages", "WORDS", Offers::words, "starts|search|tracing|branches|finish"},
    {"", "--season", "WORD", Offers::words, "summer|autumn|winter|spring"},
    {"", "--detail", "WORD|NUMBER", Offers::words, "low|medium|high"},
    {"", "--background", "WORD", Offers::words, "sky|white|transparent"},
    {"", "--sun", "AZ,EL"},
    {"", "--up", "AXIS", Offers::words, "y|z"},
    {"", "--encoding", "WORD", Offers::words, "monotone|raw"},
    {"params", "--format", "WORD", Offers::words, "text|markdown|json"},
    {"export", "--format", "WORD", Offers::words, "iohprofiler|coco"},
    {"", "--free", "NAMES", Offers::words, "parameters"},
    {"", "--fix", "NAME=VALUE", Offers::words, "parameters"},
    {"run", "--set", "KEY=VALUE"},
    {"", "--set", "NAME=VALUE", Offers::words, "parameters"},
    {"", "--set-optimizer", "NAME=VALUE"},
    {"", "--view", "AZ,EL"},
    {"", "--grid", "COLSxROWS"},
    {"", "--at", "X,Y"},
    {"", "--strip", "N FILE", Offers::files},
    {"space", "--components", "N"},
    {"fit", "--space", "species:K"},
    {"fit", "image", "PICTURE", Offers::files},
    {"", "image", "PICTURE", Offers::files},
    {"", "preset", "TREE", Offers::words, "plants"},
    {"", "other", "TREE", Offers::words, "plants"},
    {"lsystem", "file", "FILE", Offers::words, "lsystems"},
    {"run", "file", "FILE", Offers::files},
    {"", "run", "DIR", Offers::directories},
    {"", "directory", "DIR", Offers::directories},
    {"", "first", "DIR", Offers::directories},
    {"", "second", "DIR", Offers::directories},
    {"", "expected", "FILE", Offers::files},
    {"", "candidate", "PICTURE", Offers::files},
    {"", "target", "PICTURE", Offers::files},
    {"space", "picture", "FILE", Offers::files},
    {"", "shell", "SHELL", Offers::words, "bash|zsh|fish"},
    {"", "topic", "TOPIC", Offers::words, "topics"},
};

/// Rows of one command stand before those of all.
const ValueName* find_row(std::string_view command, std::string_view option) {
  const auto is_it = [&](std::string_view of) {
    return [=](const ValueName& row) { return row.command == of && row.option == option; };
  };
  for (const std::string_view of : {command, std::string_view{}})
    if (const auto* row = std::find_if(std::begin(kValueNames), std::end(kValueNames), is_it(of));
        row != std::end(kValueNames))
      return row;
  return nullptr;
}

std::string_view shown_type(const std::string& type) {
  if (type.starts_with("INT") || type.starts_with("UINT")) return "N";
  return type.starts_with("FLOAT") ? "NUMBER" : "TEXT";
}

}  // namespace

ValueName value_name(const CLI::App& command, const CLI::Option& option) {
  const std::string name =
      option.get_lnames().empty() ? option.get_name(true) : "--" + option.get_lnames()[0];
  if (const ValueName* row = find_row(command.get_name(), name)) return *row;
  return {.command = {}, .option = {}, .shown = shown_type(option.get_type_name())};
}

std::vector<std::string> words_for(const ValueName& value, const WordLists& lists) {
  if (const auto found = lists.find(value.list); found != lists.end()) return found->second;
  std::vector<std::string> words;
  std::string_view rest = value.list;
  while (!rest.empty()) {
    const std::size_t bar = std::min(rest.find('|'), rest.size());
    words.emplace_back(rest.substr(0, bar));
    rest.remove_prefix(std::min(bar + 1, rest.size()));
  }
  return words;
}

}  // namespace espalier
