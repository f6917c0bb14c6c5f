// espalier trials: the points that a run evaluated, as a table.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <espalier/app/commands/commands.h>
#include <espalier/app/options/run_options.h>
#include <espalier/fitting/run/run_directory.h>
#include <espalier/fitting/run/trials.h>

namespace espalier {

namespace {

struct TrialsOptions {
  std::string run, output;
  std::vector<std::string> pictures;
};

void run_trials(const TrialsOptions& options) {
  check_run_directory(options.run);
  const std::string output =
      options.output.empty() ? (std::filesystem::path(options.run) / "trials.csv").string() : options.output;
  std::string stages;
  long trials = 0;
  for (const auto& [stage, count] : write_trials(options.run, output, options.pictures)) {
    stages += fmt::format("{}{} {}", stages.empty() ? "" : ", ", name_of(stage), count);
    trials += count;
  }
  fmt::print("{}: {} trials ({})\n", output, trials, stages);
}

}  // namespace

void add_trials_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("trials", "Write the points that a run evaluated as a table, trials.csv");
  const auto options = std::make_shared<TrialsOptions>();
  command->add_option("run", options->run, "the directory of a run, finished or not")->required();
  command->add_option("-o,--output", options->output, "the table to write (default: trials.csv in the run)");
  add_picture_option(*command, options->pictures);
  command->callback([options] { run_trials(*options); });
}

}  // namespace espalier
