// espalier reference: prints a table of the program as Markdown, for the pages of docs that hold it between
// marks; docs/update_tables.py puts all of them there.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include <espalier/app/commands/commands.h>
#include <espalier/image/measures/metric_table.h>

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

struct Topic {
  const char* name;
  std::string (*markdown)();
};

constexpr Topic kTopics[] = {
    {"measures", measures_as_markdown},
};

std::vector<std::string> topic_names() {
  std::vector<std::string> names;
  for (const Topic& topic : kTopics) names.emplace_back(topic.name);
  return names;
}

void print_topic(const std::string& name) {
  for (const Topic& topic : kTopics)
    if (topic.name == name) fmt::print("{}", topic.markdown());
}

}  // namespace

void add_reference_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("reference", "Print a table of the docs as Markdown");
  const auto topic = std::make_shared<std::string>();
  command->add_option("topic", *topic, "which table")->required()->check(CLI::IsMember(topic_names()));
  command->callback([topic] { print_topic(*topic); });
}

}  // namespace espalier
