#include <fmt/format.h>

#include <espalier/app/options/fit_option_docs.h>
#include <espalier/app/options/option_names.h>
#include <espalier/app/options/record_options.h>
#include <espalier/fitting/record/fit_options.h>
#include <espalier/fitting/record/option_values.h>

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

}  // namespace

std::string fit_options_as_markdown() {
  std::string text =
      "| option | run.toml | experiment | values | default | since | on resume | meaning |\n"
      "|---|---|---|---|---|---|---|---|\n";
  for (const FitOption& option : fit_options()) text += markdown_line(option);
  return text;
}

}  // namespace espalier
