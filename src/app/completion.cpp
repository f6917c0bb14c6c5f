#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <string_view>
#include <vector>

#include <espalier/app/completion.h>

namespace espalier {

namespace {

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_name().empty(); });
}

std::vector<const CLI::Option*> options_of(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) { return !option->get_lnames().empty(); });
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

bool takes_preset(const CLI::App& command) {
  return !command.get_options([](const CLI::Option* option) { return option->get_name() == "preset"; })
              .empty();
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

/// The words that may follow a command: its options, and presets where it takes one.
std::string words_of(const CLI::App& command, std::span<const std::string> presets) {
  std::vector<std::string> words;
  for (const CLI::App* sub : commands_of(command)) words.push_back(sub->get_name());
  for (const CLI::Option* option : options_of(command))
    for (const std::string& name : option->get_lnames()) words.push_back("--" + name);
  if (takes_preset(command)) words.insert(words.end(), presets.begin(), presets.end());
  return fmt::format("{}", fmt::join(words, " "));
}

std::string zsh_argument(const CLI::Option& option) {
  const std::string help = escaped(option.get_description(), "[]:\\");
  return shell_quoted(fmt::format("--{}[{}]{}", option.get_lnames().front(), help,
                                  takes_value(option) ? ":value:_files" : ""));
}

std::string zsh_command(const CLI::App& command, std::span<const std::string> presets) {
  std::string arguments;
  for (const CLI::Option* option : options_of(command)) arguments += " " + zsh_argument(*option);
  if (takes_preset(command))
    arguments += " " + shell_quoted(fmt::format("1:preset:{{compadd {}; _files}}", fmt::join(presets, " ")));
  return fmt::format("    {}) _arguments{} '*:file:_files' ;;\n", command.get_name(), arguments);
}

std::string fish_option(const CLI::Option& option, std::string_view condition) {
  return fmt::format("complete -c espalier -n '{}' -l {}{} -d '{}'\n", condition, option.get_lnames().front(),
                     takes_value(option) ? " -r" : "", escaped(option.get_description(), "'\\"));
}

std::string fish_command(const CLI::App& command, std::span<const std::string> presets) {
  const std::string condition = "__fish_seen_subcommand_from " + command.get_name();
  std::string text = fmt::format("complete -c espalier -n __fish_use_subcommand -f -a {} -d '{}'\n",
                                 command.get_name(), escaped(command.get_description(), "'\\"));
  for (const CLI::Option* option : options_of(command)) text += fish_option(*option, condition);
  if (takes_preset(command))
    text += fmt::format("complete -c espalier -n '{}' -a '{}'\n", condition, fmt::join(presets, " "));
  return text;
}

}  // namespace

std::string bash_completion(const CLI::App& app, std::span<const std::string> presets) {
  std::string cases;
  for (const CLI::App* command : commands_of(app))
    cases +=
        fmt::format("    {}) words={} ;;\n", command->get_name(), shell_quoted(words_of(*command, presets)));
  return fmt::format(R"(# bash completion of espalier
_espalier() {{
  local words={}
  [[ $COMP_CWORD -gt 1 ]] && case ${{COMP_WORDS[1]}} in
{}  esac
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "${{COMP_WORDS[COMP_CWORD]}}")
}}
complete -o default -F _espalier espalier
)",
                     shell_quoted(words_of(app, {})), cases);
}

std::string zsh_completion(const CLI::App& app, std::span<const std::string> presets) {
  std::string names, cases;
  for (const CLI::App* command : commands_of(app)) {
    names += fmt::format(
        "      {}\n", shell_quoted(command->get_name() + ":" + escaped(command->get_description(), ":\\")));
    cases += zsh_command(*command, presets);
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
{}  esac
}}
compdef _espalier espalier
)",
                     names, cases);
}

std::string fish_completion(const CLI::App& app, std::span<const std::string> presets) {
  std::string text = "# fish completion of espalier\n";
  for (const CLI::Option* option : options_of(app)) text += fish_option(*option, "__fish_use_subcommand");
  for (const CLI::App* command : commands_of(app)) text += fish_command(*command, presets);
  return text;
}

}  // namespace espalier
