// espalier params: the parameter table of a model as text, Markdown or JSON.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include <espalier/app/commands/commands.h>
#include <espalier/app/parameter_docs.h>
#include <espalier/models/models.h>

namespace espalier {

namespace {

struct ParamsOptions {
  std::string format = "text";
  std::string model = "weber_penn";
};

void print_parameters(const ParamsOptions& options) {
  const ParameterTable& table = model_by_name(options.model).table();
  if (options.format == "markdown")
    fmt::print("{}", parameters_as_markdown(table));
  else if (options.format == "json")
    fmt::print("{}", parameters_as_json(table));
  else
    fmt::print("{}", parameters_as_text(table));
}

}  // namespace

void add_params_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("params", "List the parameters of a model: units, bounds, meaning");
  const auto options = std::make_shared<ParamsOptions>();
  command->add_option("--format", options->format, "text, markdown or json")
      ->check(CLI::IsMember({"text", "markdown", "json"}))
      ->capture_default_str();
  command->add_option("--model", options->model, "the model's name")->capture_default_str();
  command->callback([options] { print_parameters(*options); });
}

}  // namespace espalier
