// espalier completion bash|zsh|fish: a script for the shell, made from the commands there are.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include <espalier/app/commands/commands.h>
#include <espalier/app/completion.h>
#include <espalier/fitting/optimizers/optimizer.h>
#include <espalier/image/measures/objective.h>
#include <espalier/lsystem/files/bundled.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>

namespace espalier {

namespace {

std::vector<std::string> optimizer_names() {
  std::vector<std::string> names;
  for (const auto& optimizer : all_optimizers()) names.push_back(optimizer->name());
  return names;
}

/// With the ending by which they are named besides presets.
std::vector<std::string> lsystem_names(const char* ending) {
  std::vector<std::string> names;
  for (const std::string& name : lsystem::bundled_names()) names.push_back(name + ending);
  return names;
}

std::vector<std::string> parameter_names() {
  std::vector<std::string> names;
  for (const ParameterInfo& row : model_by_name("weber_penn").table().rows) names.push_back(row.full_name());
  return names;
}

std::vector<std::string> both(std::vector<std::string> words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// By the names that app/value_names.cpp gives them.
WordLists all_lists() {
  return {{"presets", bundled_presets()},
          {"plants", both(bundled_names(), lsystem_names(".lsys"))},
          {"starts", both({"auto", "defaults", "random:8"}, bundled_presets())},
          {"models", both({"weber_penn"}, lsystem_names(".lsys"))},
          {"lsystems", lsystem_names("")},
          {"optimizers", optimizer_names()},
          {"measures", objective_names()},
          {"parameters", parameter_names()},
          {"topics", reference_topics()}};
}

void print_completion(const CLI::App& app, const std::string& shell) {
  const WordLists lists = all_lists();
  if (shell == "bash")
    fmt::print("{}", bash_completion(app, lists));
  else if (shell == "zsh")
    fmt::print("{}", zsh_completion(app, lists));
  else
    fmt::print("{}", fish_completion(app, lists));
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
