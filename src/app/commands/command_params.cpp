// espalier params: the parameter table of a model, or that of the options of a fit, as text, Markdown or
// JSON.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include <espalier/app/commands/commands.h>
#include <espalier/app/options/fit_option_docs.h>
#include <espalier/app/parameter_docs.h>
#include <espalier/models/models.h>

namespace espalier {

namespace {

struct ParamsOptions {
  std::string format = "text";
  std::string model = "weber_penn";
  bool of_fit = false;
};

std::string parameters_as(const std::string& format, const ParameterTable& table) {
  if (format == "markdown") return parameters_as_markdown(table);
  return format == "json" ? parameters_as_json(table) : parameters_as_text(table);
}

std::string fit_options_as(const std::string& format) {
  if (format == "markdown") return fit_options_as_markdown();
  return format == "json" ? fit_options_as_json() : fit_options_as_text();
}

void print_parameters(const ParamsOptions& options) {
  fmt::print("{}", options.of_fit ? fit_options_as(options.format)
                                  : parameters_as(options.format, model_by_name(options.model).table()));
}

}  // namespace

void add_params_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("params", "List the parameters of a model: units, bounds, meaning");
  const auto options = std::make_shared<ParamsOptions>();
  command->add_option("--format", options->format, "text, markdown or json")
      ->check(CLI::IsMember({"text", "markdown", "json"}))
      ->capture_default_str();
  CLI::Option* model =
      command->add_option("--model", options->model, "the model's name")->capture_default_str();
  command->add_flag("--fit", options->of_fit, "the options of a fit instead: names, keys of files, values")
      ->excludes(model);
  command->callback([options] { print_parameters(*options); });
}

}  // namespace espalier
