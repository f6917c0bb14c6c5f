// espalier reference: prints a table of the program as Markdown, for the pages of docs that hold it between
// marks; docs/update_tables.py puts all of them there.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <espalier/app/commands/commands.h>
#include <espalier/app/options/fit_option_docs.h>
#include <espalier/experiments/declaration/experiment_keys.h>
#include <espalier/fitting/optimizers/optimizer.h>
#include <espalier/image/measures/metric_table.h>
#include <espalier/lsystem/strings/turtle_commands.h>

namespace espalier {

namespace {

std::string measures_as_markdown() {
  std::string text =
      "| measure | best | in objectives | what it is |\n"
      "|---|--:|---|---|\n";
  for (const Metric& metric : kMetrics)
    text += fmt::format("| `{}` | {} | {} | {} |\n", metric.name, metric.better == Better::larger ? 1 : 0,
                        !metric.in_objective ? "no"
                        : metric.also_called ? fmt::format("yes, also as `{}`", metric.also_called)
                                             : "yes",
                        metric.help);
  return text;
}

std::string or_text(const std::vector<std::string>& texts) {
  return fmt::format("{}", fmt::join(texts, " or "));
}

/// "0 to 5", or "3" where there is no choice.
std::string counts_of(const lsystem::CommandInfo& info) {
  return info.least == info.most ? fmt::format("{}", info.most)
                                 : fmt::format("{} to {}", info.least, info.most);
}

/// Of a symbol with its parameters; "|" would end the cell.
std::string symbol_as_markdown(std::string_view symbol, std::string_view parameters) {
  if (symbol == "|") return "<code>&#124;</code>";
  return parameters.empty() ? fmt::format("`{}`", symbol) : fmt::format("`{}({})`", symbol, parameters);
}

std::string lsystem_commands_as_markdown() {
  std::string text =
      "| symbol | parameters | command |\n"
      "|---|---|---|\n";
  for (const lsystem::CommandInfo& info : lsystem::kCommands) {
    std::vector<std::string> symbols{symbol_as_markdown(info.symbol, info.parameters)};
    if (!info.other_symbol.empty()) symbols.push_back(symbol_as_markdown(info.other_symbol, ""));
    text += fmt::format("| {} | {} | {} |\n", or_text(symbols), counts_of(info), info.help);
  }
  return text;
}

std::string optimizers_as_markdown() {
  std::string text =
      "| optimiser | what it is | settings, with their defaults |\n"
      "|---|---|---|\n";
  for (const auto& optimizer : all_optimizers()) {
    std::vector<std::string> settings;
    for (const OptimizerSetting& setting : optimizer->settings())
      settings.push_back(fmt::format("`{}` {}", setting.name, setting.default_value));
    text +=
        fmt::format("| `{}` | {} | {} |\n", optimizer->name(), optimizer->help(), fmt::join(settings, ", "));
  }
  return text;
}

struct Topic {
  const char* name;
  std::string (*markdown)();
};

constexpr Topic kTopics[] = {
    {"fit", fit_options_as_markdown},       {"experiment", experiment_keys_as_markdown},
    {"measures", measures_as_markdown},     {"lsystem-commands", lsystem_commands_as_markdown},
    {"optimizers", optimizers_as_markdown},
};

void print_topic(const std::string& name) {
  for (const Topic& topic : kTopics)
    if (topic.name == name) fmt::print("{}", topic.markdown());
}

}  // namespace

std::vector<std::string> reference_topics() {
  std::vector<std::string> names;
  for (const Topic& topic : kTopics) names.emplace_back(topic.name);
  return names;
}

void add_reference_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("reference", "Print a table of the docs as Markdown");
  const auto topic = std::make_shared<std::string>();
  command->add_option("topic", *topic, "which table")->required()->check(CLI::IsMember(reference_topics()));
  command->callback([topic] { print_topic(*topic); });
}

}  // namespace espalier
