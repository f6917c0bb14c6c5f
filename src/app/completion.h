// Completion of the command line for shells, generated from the commands and options there are, and from what
// they take (app/value_names.h).
// Usage: source <(espalier completion bash), source <(espalier completion zsh),
// espalier completion fish | source.
#pragma once
#include <string>

#include <espalier/app/value_names.h>

namespace CLI {
class App;
}

namespace espalier {

/// `lists` holds the words of values that are names, such as presets.
std::string bash_completion(const CLI::App& app, const WordLists& lists);
std::string zsh_completion(const CLI::App& app, const WordLists& lists);
std::string fish_completion(const CLI::App& app, const WordLists& lists);

}  // namespace espalier
