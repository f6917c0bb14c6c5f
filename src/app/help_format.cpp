#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <vector>

#include <espalier/app/help_format.h>
#include <espalier/app/value_names.h>

namespace espalier {

namespace {

constexpr std::size_t kIndent = 28;

/// Of UTF-8: every byte but those that continue a character begins one.
std::size_t count_columns(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0) != 0x80; }));
}

bool is_argument(const CLI::Option& option) {
  return option.get_lnames().empty() && option.get_snames().empty();
}

/// "  --seconds NUMBER=20"
std::string head_of(const CLI::App& command, const CLI::Option& option) {
  std::string head = "  " + option.get_name(is_argument(option), true);
  if (option.get_items_expected_max() == 0) return head;
  head += fmt::format(" {}", value_name(command, option).shown);
  return option.get_default_str().empty() ? head : head + "=" + option.get_default_str();
}

std::string lines_of(const CLI::App& command, const std::string& title,
                     const std::vector<const CLI::Option*>& options) {
  if (options.empty()) return "";
  std::string lines = fmt::format("\n{}:\n", title);
  for (const CLI::Option* option : options)
    lines += in_columns(head_of(command, *option),
                        option->get_description() + (option->get_required() ? " (needed)" : ""), kIndent);
  return lines;
}

std::string usage_of(const CLI::App& command, const std::string& name) {
  std::string line = "Usage: " + name;
  if (!command.get_subcommands({}).empty()) return line + " COMMAND [OPTIONS]\n";
  for (const CLI::Option* option : command.get_options())
    if (is_argument(*option))
      line += option->get_required() ? " " + option->get_name(true) : " [" + option->get_name(true) + "]";
  return line + " [OPTIONS]\n";
}

std::string options_of_help(const CLI::App& command) {
  std::string lines =
      lines_of(command, "Arguments",
               command.get_options([](const CLI::Option* option) { return is_argument(*option); }));
  for (const std::string& group : command.get_groups())
    if (!group.empty())
      lines += lines_of(command, group, command.get_options([&](const CLI::Option* option) {
        return !is_argument(*option) && option->get_group() == group;
      }));
  return lines;
}

std::string commands_of_help(const CLI::App& app) {
  std::string lines;
  std::vector<std::string> groups;
  for (const CLI::App* command : app.get_subcommands({}))
    if (std::find(groups.begin(), groups.end(), command->get_group()) == groups.end())
      groups.push_back(command->get_group());
  for (const std::string& group : groups) {
    lines += fmt::format("\n{}:\n", group == "Subcommands" ? "Commands" : group);
    for (const CLI::App* command : app.get_subcommands({}))
      if (command->get_group() == group)
        lines += in_columns("  " + command->get_name(), command->get_description(), 14);
  }
  return lines;
}

}  // namespace

std::string in_columns(const std::string& head, const std::string& text, std::size_t indent) {
  const std::string margin(indent, ' ');
  std::size_t column = count_columns(head);
  std::string lines = head + (head.empty()          ? margin
                              : column + 2 > indent ? "\n" + margin
                                                    : std::string(indent - column, ' '));
  column = indent;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::size_t width = count_columns(word);
    if (column > indent && column + 1 + width > kHelpColumns) {
      lines += "\n" + margin;
      column = indent;
    }
    if (column > indent) lines += ' ', ++column;
    lines += word;
    column += width;
  }
  return lines + "\n";
}

std::string HelpFormat::make_help(const CLI::App* command, std::string name,
                                  CLI::AppFormatMode /*mode*/) const {
  const std::string footer = command->get_footer();
  return in_columns("", command->get_description(), 0) + "\n" + usage_of(*command, name) +
         options_of_help(*command) + commands_of_help(*command) +
         (footer.empty() ? "" : "\n" + footer + "\n");
}

}  // namespace espalier
