// espalier completion bash|zsh|fish: a script for the shell, made from the commands there are.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include <espalier/app/commands/commands.h>
#include <espalier/app/completion.h>
#include <espalier/models/preset.h>

namespace espalier {

namespace {

void print_completion(const CLI::App& app, const std::string& shell) {
  const std::vector<std::string> presets = bundled_names();
  if (shell == "bash")
    fmt::print("{}", bash_completion(app, presets));
  else if (shell == "zsh")
    fmt::print("{}", zsh_completion(app, presets));
  else
    fmt::print("{}", fish_completion(app, presets));
}

}  // namespace

void add_completion_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("completion", "Print the completion script of a shell");
  const auto shell = std::make_shared<std::string>();
  command->add_option("shell", *shell, "bash, zsh or fish")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  command->callback([&app, shell] { print_completion(app, *shell); });
}

}  // namespace espalier
