#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <string_view>
#include <vector>

#include <espalier/app/completion.h>

namespace espalier {

namespace {

using Options = std::vector<const CLI::Option*>;

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_name().empty(); });
}

Options options_of(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) { return !option->get_lnames().empty(); });
}

Options arguments_of(const CLI::App& app) {
  return app.get_options(
      [](const CLI::Option* option) { return option->get_lnames().empty() && option->get_snames().empty(); });
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

/// All commands and theirs, with their names: "experiment run".
std::vector<std::pair<std::string, const CLI::App*>> named_commands(const CLI::App& app) {
  std::vector<std::pair<std::string, const CLI::App*>> named;
  for (const CLI::App* command : commands_of(app)) {
    named.emplace_back(command->get_name(), command);
    for (const auto& [name, sub] : named_commands(*command))
      named.emplace_back(command->get_name() + " " + name, sub);
  }
  return named;
}

/// `text` with a backslash before each of `special`.
std::string escaped(std::string_view text, std::string_view special) {
  std::string result;
  for (const char c : text) {
    if (special.find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return result;
}

/// `text` between single quotes of bash and zsh.
std::string shell_quoted(std::string_view text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::string joined(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, " ")); }

/// The words that may follow a command: its commands, its options, and words for its arguments.
std::vector<std::string> words_after(const CLI::App& command, const WordLists& lists) {
  std::vector<std::string> words;
  for (const CLI::App* sub : commands_of(command)) words.push_back(sub->get_name());
  for (const CLI::Option* option : options_of(command))
    for (const std::string& name : option->get_lnames()) words.push_back("--" + name);
  for (const CLI::Option* argument : arguments_of(command))
    for (std::string& word : words_for(value_name(command, *argument), lists))
      words.push_back(std::move(word));
  return words;
}

// bash

/// A case for each option whose values are words; other values are files, bash's own default.
std::string bash_values(const std::string& name, const CLI::App& command, const WordLists& lists) {
  std::string cases;
  for (const CLI::Option* option : options_of(command)) {
    if (!takes_value(*option)) continue;
    const std::string words = joined(words_for(value_name(command, *option), lists));
    cases +=
        fmt::format("    '{} --{}') words={} ;;\n", name, option->get_lnames().front(), shell_quoted(words));
  }
  return cases;
}

// zsh

std::string zsh_value(const CLI::App& command, const CLI::Option& option, const WordLists& lists) {
  const ValueName value = value_name(command, option);
  const std::vector<std::string> words = words_for(value, lists);
  const std::string shown = escaped(value.shown, ":\\");
  if (!words.empty()) return fmt::format(":{}:({})", shown, escaped(joined(words), ":\\()"));
  if (value.offers == Offers::directories) return fmt::format(":{}:_files -/", shown);
  return fmt::format(":{}:{}", shown, value.offers == Offers::files ? "_files" : "");
}

std::string zsh_argument(const CLI::App& command, const CLI::Option& option, const WordLists& lists) {
  const std::string help = escaped(option.get_description(), "[]:\\");
  return shell_quoted(fmt::format("--{}[{}]{}", option.get_lnames().front(), help,
                                  takes_value(option) ? zsh_value(command, option, lists) : ""));
}

std::string zsh_command(const std::string& name, const CLI::App& command, const WordLists& lists) {
  std::string arguments;
  for (const CLI::Option* option : options_of(command))
    arguments += " " + zsh_argument(command, *option, lists);
  std::vector<std::string> words;
  for (const CLI::Option* argument : arguments_of(command))
    for (std::string& word : words_for(value_name(command, *argument), lists))
      words.push_back(std::move(word));
  for (const CLI::App* sub : commands_of(command)) words.push_back(sub->get_name());
  if (!words.empty())
    arguments += " " + shell_quoted(fmt::format("1:word:{{compadd -- {}; _files}}", joined(words)));
  return fmt::format("    '{}') _arguments{} '*:file:_files' ;;\n", name, arguments);
}

// fish

std::string fish_value(const CLI::App& command, const CLI::Option& option, const WordLists& lists) {
  if (!takes_value(option)) return "";
  const ValueName value = value_name(command, option);
  const std::vector<std::string> words = words_for(value, lists);
  if (!words.empty()) return fmt::format(" -x -a '{}'", escaped(joined(words), "'\\"));
  if (value.offers == Offers::directories) return " -x -a '(__fish_complete_directories)'";
  return value.offers == Offers::files ? " -r -F" : " -x";
}

std::string fish_option(const CLI::App& command, const CLI::Option& option, std::string_view condition,
                        const WordLists& lists) {
  return fmt::format("complete -c espalier -n '{}' -l {}{} -d '{}'\n", condition, option.get_lnames().front(),
                     fish_value(command, option, lists), escaped(option.get_description(), "'\\"));
}

/// "__fish_seen_subcommand_from experiment; and __fish_seen_subcommand_from run"
std::string fish_condition(const std::string& name) {
  std::string condition;
  for (std::size_t from = 0, space = 0; space != std::string::npos; from = space + 1) {
    space = name.find(' ', from);
    condition += (from == 0 ? "" : "; and ") + std::string("__fish_seen_subcommand_from ") +
                 name.substr(from, space == std::string::npos ? space : space - from);
  }
  return condition;
}

std::string fish_command(const std::string& name, const CLI::App& command, const WordLists& lists) {
  const std::string condition = fish_condition(name);
  std::string text;
  for (const CLI::App* sub : commands_of(command))
    text += fmt::format("complete -c espalier -n '{}' -f -a {} -d '{}'\n", condition, sub->get_name(),
                        escaped(sub->get_description(), "'\\"));
  for (const CLI::Option* option : options_of(command))
    text += fish_option(command, *option, condition, lists);
  for (const CLI::Option* argument : arguments_of(command))
    if (const auto words = words_for(value_name(command, *argument), lists); !words.empty())
      text += fmt::format("complete -c espalier -n '{}' -a '{}'\n", condition, escaped(joined(words), "'\\"));
  return text;
}

}  // namespace

std::string bash_completion(const CLI::App& app, const WordLists& lists) {
  std::string values, cases, parents;
  for (const auto& [name, command] : named_commands(app)) {
    values += bash_values(name, *command, lists);
    cases +=
        fmt::format("      '{}') words={} ;;\n", name, shell_quoted(joined(words_after(*command, lists))));
    if (!commands_of(*command).empty()) parents += (parents.empty() ? "" : "|") + name;
  }
  return fmt::format(R"(# bash completion of espalier
_espalier() {{
  local words={} command=${{COMP_WORDS[1]}}
  case $command in
    {}) [[ $COMP_CWORD -gt 2 ]] && command+=" ${{COMP_WORDS[2]}}" ;;
  esac
  [[ $COMP_CWORD -gt 1 ]] && case "$command ${{COMP_WORDS[COMP_CWORD-1]}}" in
{}    *) case $command in
{}      esac ;;
  esac
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "${{COMP_WORDS[COMP_CWORD]}}")
}}
complete -o default -F _espalier espalier
)",
                     shell_quoted(joined(words_after(app, {}))), parents.empty() ? "''" : parents, values,
                     cases);
}

std::string zsh_completion(const CLI::App& app, const WordLists& lists) {
  std::string names, cases, parents;
  for (const CLI::App* command : commands_of(app))
    names += fmt::format(
        "      {}\n", shell_quoted(command->get_name() + ":" + escaped(command->get_description(), ":\\")));
  for (const auto& [name, command] : named_commands(app)) {
    cases += zsh_command(name, *command, lists);
    if (!commands_of(*command).empty()) parents += (parents.empty() ? "" : "|") + name;
  }
  return fmt::format(R"(#compdef espalier
_espalier() {{
  if (( CURRENT == 2 )); then
    local -a commands=(
{}    )
    _describe command commands
    return
  fi
  local command=$words[2]
  shift words
  (( CURRENT-- ))
  case $command in
    {})
      if (( CURRENT > 2 )); then
        command+=" $words[2]"
        shift words
        (( CURRENT-- ))
      fi ;;
  esac
  case $command in
{}  esac
}}
compdef _espalier espalier
)",
                     names, parents.empty() ? "''" : parents, cases);
}

std::string fish_completion(const CLI::App& app, const WordLists& lists) {
  std::string text = "# fish completion of espalier\n";
  for (const CLI::Option* option : options_of(app))
    text += fish_option(app, *option, "__fish_use_subcommand", lists);
  for (const CLI::App* command : commands_of(app))
    text += fmt::format("complete -c espalier -n __fish_use_subcommand -f -a {} -d '{}'\n",
                        command->get_name(), escaped(command->get_description(), "'\\"));
  for (const auto& [name, command] : named_commands(app)) text += fish_command(name, *command, lists);
  return text;
}

}  // namespace espalier
