// Completion of the command line for shells, generated from the commands and options there are.
// Usage: source <(espalier completion bash), source <(espalier completion zsh),
// espalier completion fish | source.
#pragma once
#include <span>
#include <string>

namespace CLI {
class App;
}

namespace espalier {

/// `presets` completes positional arguments named "preset", besides file names.
std::string bash_completion(const CLI::App& app, std::span<const std::string> presets);
std::string zsh_completion(const CLI::App& app, std::span<const std::string> presets);
std::string fish_completion(const CLI::App& app, std::span<const std::string> presets);

}  // namespace espalier
