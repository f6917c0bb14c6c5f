#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <optional>
#include <utility>
#include <vector>

#include <espalier/app/main/wrong_words.h>
#include <espalier/core/near_name.h>

namespace espalier {

namespace {

/// What people call a command or an option that has another name here.
constexpr std::pair<std::string_view, std::string_view> kOtherCommands[] = {
    {"grow", "render"},         {"draw", "render"},
    {"export", "mesh"},         {"list", "species"},
    {"presets", "species"},     {"lsystems", "lsystem"},
    {"silhouette", "mask"},     {"optimize", "fit"},
    {"run", "experiment run"},  {"report", "experiment report"},
    {"resume", "fit --resume"}, {"version", "--version"},
    {"help", "--help"},
};
constexpr std::pair<std::string_view, std::string_view> kOtherOptions[] = {
    {"--time", "--seconds"},       {"--timeout", "--seconds"},
    {"--duration", "--seconds"},   {"--iterations", "--evaluations"},
    {"--budget", "--evaluations"}, {"--trials", "--evaluations"},
    {"--resolution", "--size"},    {"--width", "--size"},
    {"--jobs", "--threads"},       {"--threads", "--jobs"},
    {"--workers", "--threads"},    {"--algorithm", "--optimizer"},
    {"--method", "--optimizer"},   {"--measure", "--objective"},
    {"--metric", "--objective"},   {"--fitness", "--objective"},
    {"--preset", "--start"},       {"--continue", "--resume"},
    {"--verbose", "--help"},       {"--param", "--set"},
    {"--parameter", "--set"},      {"--angle", "--azimuth"},
    {"--lod", "--detail"},         {"--quality", "--detail"},
    {"--level", "--detail"},       {"--rays", "--samples"},
    {"--silent", "--quiet"},       {"--file", "--output"},
    {"--directory", "--output"},   {"--format", "--output"},
};

std::vector<const CLI::App*> commands_in(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_name().empty(); });
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands_in(app)) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// "espalier experiment run".
std::string full_name(const CLI::App& command) {
  return command.get_parent() ? full_name(*command.get_parent()) + " " + command.get_name()
                              : command.get_name();
}

/// "experiment run: ", nothing for the program itself.
std::string place(const CLI::App& command) {
  return command.get_parent() ? full_name(command).substr(full_name(command).find(' ') + 1) + ": " : "";
}

std::string see_help(const CLI::App& command) { return fmt::format(" (see: {} --help)", full_name(command)); }

template <std::size_t size>
std::optional<std::string> other_word(const std::pair<std::string_view, std::string_view> (&words)[size],
                                      std::string_view word, const std::vector<std::string>& known) {
  for (const auto& [other, name] : words)
    if (other == word && (known.empty() || std::find(known.begin(), known.end(), name) != known.end()))
      return std::string(name);
  return std::nullopt;
}

bool is_picture_name(const std::string& word) {
  for (const char* ending : {".png", ".jpg", ".jpeg", ".tif", ".tiff", ".webp", ".gif"})
    if (word.ends_with(ending)) return true;
  return false;
}

/// Of a word where a command was expected.
std::string wrong_command(const CLI::App& app, const std::string& word) {
  const std::string head = fmt::format("{}got '{}', which is no command", place(app), word);
  if (word.starts_with('-'))
    return fmt::format("{}got '{}', expected a command before its options: {}", place(app), word,
                       fmt::join(command_names(app), ", "));
  if (is_picture_name(word))
    return fmt::format("{}: did you mean '{} fit {}'?{}", head, full_name(app), word, see_help(app));
  auto meant = app.get_parent() ? std::nullopt : other_word(kOtherCommands, word, {});
  if (!meant) meant = near_name(word, command_names(app));
  if (meant) return fmt::format("{}: did you mean '{} {}'?", head, full_name(app), *meant);
  return fmt::format("{}, expected one of: {}", head, fmt::join(command_names(app), ", "));
}

/// "an option of render and mask", where it is one of other commands.
std::string whose_option(const CLI::App& command, const std::string& name) {
  const CLI::App* program = &command;
  while (program->get_parent()) program = program->get_parent();
  std::vector<std::string> owners;
  for (const CLI::App* other : commands_in(*program))
    if (other->get_option_no_throw(name)) owners.push_back(other->get_name());
  return owners.empty() ? "" : fmt::format("; it is one of {}", fmt::join(owners, ", "));
}

std::string wrong_option(const CLI::App& command, const std::string& name) {
  const std::string head =
      fmt::format("{}got '{}', which is no option of {}{}", place(command), name,
                  command.get_parent() ? command.get_name() : "the program", whose_option(command, name));
  const std::vector<std::string> known = option_names(command);
  auto meant = other_word(kOtherOptions, name, known);
  if (!meant && !name.starts_with("--")) meant = near_name("-" + name, known);
  if (!meant && name.starts_with("--")) meant = near_name(name, known);
  if (meant) return fmt::format("{}: did you mean {}?{}", head, *meant, see_help(command));
  return head + see_help(command);
}

std::string word_too_many(const CLI::App& command, const std::string& word) {
  const std::string head = fmt::format("{}got '{}', which is one word too many", place(command), word);
  const std::vector<std::string> known = option_names(command);
  const std::string as_option = "--" + word.substr(0, word.find('='));
  if (std::find(known.begin(), known.end(), as_option) != known.end())
    return fmt::format("{}: did you mean --{}?{}", head, word, see_help(command));
  return fmt::format("{}: a text of several words is put between quotes{}", head, see_help(command));
}

bool is_option_word(const std::string& word) {
  return word.size() > 1 && word[0] == '-' && (std::isdigit(static_cast<unsigned char>(word[1])) == 0);
}

/// The option that a word begins, and whether its value is in the same word.
struct OptionWord {
  const CLI::Option* option;
  std::string name;
  bool has_value;
};

OptionWord look_up(const CLI::App& command, const std::string& word) {
  const bool is_long = word.starts_with("--");
  const std::string name = is_long ? word.substr(0, word.find('=')) : word.substr(0, 2);
  return {command.get_option_no_throw(name), is_long ? name : word, word.size() > name.size()};
}

/// How many of the words that follow are values of the option.
std::size_t count_values(const CLI::Option& option, std::span<const std::string> following) {
  const int most = option.get_items_expected_max();
  const auto least = static_cast<std::size_t>(std::max(0, option.get_items_expected_min()));
  if (most == 0) return 0;
  std::size_t count = std::min(least, following.size());
  if (option.get_allow_extra_args())
    while (count < static_cast<std::size_t>(most) && count < following.size() &&
           !is_option_word(following[count]))
      ++count;
  return count;
}

std::size_t count_positionals(const CLI::App& command) {
  std::size_t most = 0;
  for (const CLI::Option* option : command.get_options())
    if (option->get_positional())
      most += static_cast<std::size_t>(std::max(0, option->get_items_expected_max()));
  return most;
}

/// Of the words behind a command: the first that is no option of it, or one too many; nothing where all fit.
std::optional<std::string> wrong_word(const CLI::App& command, std::span<const std::string> words) {
  std::size_t places = count_positionals(command);
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--") return std::nullopt;
    if (is_option_word(words[i])) {
      const OptionWord found = look_up(command, words[i]);
      if (!found.option) return wrong_option(command, found.name);
      if (!found.has_value) i += count_values(*found.option, words.subspan(i + 1));
    } else if (places == 0) {
      return word_too_many(command, words[i]);
    } else {
      --places;
    }
  }
  return std::nullopt;
}

/// "-o,--output" as "--output", a positional by its name.
std::string shown_name(const CLI::Option& option) {
  return option.get_lnames().empty() ? option.get_name(true) : "--" + option.get_lnames().front();
}

std::string expected_value(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const char* kind = type.starts_with("INT")     ? "a whole number"
                     : type.starts_with("UINT")  ? "a whole number from 0"
                     : type.starts_with("FLOAT") ? "a number"
                                                 : "a value";
  return fmt::format("expected {}: {}", kind, option.get_description());
}

std::string missing_option(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options())
    if (option->get_required() && option->count() == 0)
      return fmt::format("{}got no {}, expected {}{}", place(command), shown_name(*option),
                         option->get_description(), see_help(command));
  return "";
}

/// The option whose name opens CLI11's message.
const CLI::Option* option_in(const CLI::App& command, const std::string& message) {
  for (const CLI::Option* option : command.get_options()) {
    std::vector<std::string> names = {option->get_name(true)};
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : names)
      if (message.starts_with(name) && message.find_first_of(": ", name.size()) == name.size()) return option;
  }
  return nullptr;
}

/// "Value 5000 not in range 0 to 1024" and "powershell not in {bash,zsh,fish}", which CLI11 says, with what
/// was expected.
std::string refused_value(const std::string& complaint) {
  const auto middle = complaint.find(" not in ");
  if (middle == std::string::npos) return complaint;
  const std::string range = complaint.substr(middle + 8);
  if (range.starts_with("range "))
    return fmt::format("got '{}', expected {}", complaint.substr(6, middle - 6), range.substr(6));
  std::vector<std::string> known;
  for (std::size_t from = 1, comma = 0; comma != std::string::npos; from = comma + 1) {
    comma = range.find(',', from);
    known.push_back(range.substr(from, comma == std::string::npos ? range.size() - 1 - from : comma - from));
  }
  const std::string word = complaint.substr(0, middle);
  const auto meant = near_name(word, known);
  return fmt::format("got '{}', expected one of: {}{}", word, fmt::join(known, ", "),
                     meant ? fmt::format("; did you mean {}?", *meant) : "");
}

/// CLI11's own words, with what they leave out.
std::string explain_error(const CLI::App& command, const CLI::ParseError& error) {
  const std::string message = error.what();
  if (dynamic_cast<const CLI::RequiredError*>(&error))
    if (std::string missing = missing_option(command); !missing.empty()) return missing;
  constexpr std::string_view kConversion = "Could not convert: ";
  if (message.starts_with(kConversion)) {
    const std::string rest = message.substr(kConversion.size());
    if (const CLI::Option* option = option_in(command, rest))
      return fmt::format("{}{}: got '{}', {}{}", place(command), shown_name(*option),
                         rest.substr(rest.find(" = ") + 3), expected_value(*option), see_help(command));
  }
  const CLI::Option* option = option_in(command, message);
  if (!option) return place(command) + message + see_help(command);
  if (const auto excludes = message.find(" excludes "); excludes != std::string::npos)
    return fmt::format("{}got {} and {}, expected one of the two{}", place(command), shown_name(*option),
                       message.substr(excludes + 10), see_help(command));
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error))
    return fmt::format("{}{}: got {}, {}{}", place(command), shown_name(*option),
                       option->count() > 1 ? "it more than once" : "no value", expected_value(*option),
                       see_help(command));
  return fmt::format("{}{}: {}{}", place(command), shown_name(*option),
                     refused_value(message.substr(message.find(": ") + 2)), see_help(command));
}

/// The command that the words name, down to one of its own commands: "experiment run".
const CLI::App& command_of(const CLI::App& app, std::span<const std::string> words) {
  if (words.empty()) return app;
  for (const CLI::App* command : commands_in(app))
    if (command->get_name() == words.front()) return command_of(*command, words.subspan(1));
  return app;
}

std::size_t depth_of(const CLI::App& command) {
  return command.get_parent() ? 1 + depth_of(*command.get_parent()) : 0;
}

}  // namespace

bool ends_before_command(const CLI::App& app, std::span<const std::string> words) {
  const CLI::App& command = command_of(app, words);
  return !commands_in(command).empty() && depth_of(command) == words.size();
}

std::string explain_wrong_words(const CLI::App& app, std::span<const std::string> words,
                                const CLI::ParseError& error) {
  const CLI::App& command = command_of(app, words);
  const auto rest = words.subspan(depth_of(command));
  if (!commands_in(command).empty() && !rest.empty()) {
    if (is_option_word(rest.front()) && !look_up(command, rest.front()).option)
      return wrong_option(command, look_up(command, rest.front()).name);
    return wrong_command(command, rest.front());
  }
  if (const auto wrong = wrong_word(command, rest)) return *wrong;
  return explain_error(command, error);
}

}  // namespace espalier
