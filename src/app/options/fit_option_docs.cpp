#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include <espalier/app/options/fit_option_docs.h>
#include <espalier/app/options/option_names.h>
#include <espalier/app/options/record_options.h>
#include <espalier/fitting/task/fit_options.h>
#include <espalier/fitting/task/option_values.h>

namespace espalier {

namespace {

/// Empty for a row that a user cannot say.
std::string name_of_option(const FitOption& option) {
  return option.option.empty() ? "" : option_of(std::string(option.field));
}

/// The key of an experiment, or the list that varies it.
std::string experiment_name(const FitOption& option) {
  return option.experiment_list.empty() ? experiment_key(option) : std::string(option.experiment_list);
}

std::string default_words(const FitOption& option) { return to_words(get_value(option, default_request())); }

std::string as_code(const std::string& text) { return text.empty() ? "" : fmt::format("`{}`", text); }

std::string markdown_line(const FitOption& option) {
  return fmt::format("| {} | `{}` | {} | {} | {} | {} | {} | {} |\n", as_code(name_of_option(option)),
                     option.key, as_code(experiment_name(option)), describe_values(option),
                     as_code(default_words(option)), option.since, option.resumable ? "yes" : "no",
                     option.help);
}

nlohmann::ordered_json as_json(const FitOption& option) {
  return {{"option", name_of_option(option)},
          {"key", option.key},
          {"experiment", experiment_name(option)},
          {"unit", option.unit},
          {"values", describe_values(option)},
          {"default", default_words(option)},
          {"since", option.since},
          {"resumable", option.resumable},
          {"help", option.help}};
}

}  // namespace

std::string fit_options_as_text() {
  std::string text = fmt::format("{:<20} {:<44} {}\n", "option", "values", "meaning");
  for (const FitOption& option : fit_options())
    if (!option.option.empty())
      text += fmt::format("{:<20} {:<44} {}\n", name_of_option(option), describe_values(option), option.help);
  return text;
}

std::string fit_options_as_markdown() {
  std::string text =
      "# Options of a fit\n\n"
      "Made by `espalier params --fit --format markdown`. Each option has a name on the command line, a key "
      "in\n"
      "the `run.toml` that a fit leaves, and one in the `[fits]` of an experiment: a value for all runs, or "
      "a\n"
      "list of values to compare. *Default* is that of `espalier fit`, *since* the version of the program "
      "that\n"
      "first had it; *on resume* says whether a run that goes on may have another value.\n\n"
      "| option | run.toml | experiment | values | default | since | on resume | meaning |\n"
      "|---|---|---|---|---|---|---|---|\n";
  for (const FitOption& option : fit_options()) text += markdown_line(option);
  return text;
}

std::string fit_options_as_json() {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const FitOption& option : fit_options()) rows.push_back(as_json(option));
  return nlohmann::ordered_json{{"options", rows}}.dump(2) + "\n";
}

}  // namespace espalier
