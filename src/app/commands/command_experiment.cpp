// espalier experiment: runs experiments declared as data, reports them, checks them against what is expected
// of them, and compares two of them.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include <espalier/app/commands/commands.h>
#include <espalier/app/options/json_output.h>
#include <espalier/app/options/long_work.h>
#include <espalier/app/options/messages.h>
#include <espalier/app/version.h>
#include <espalier/core/data_path.h>
#include <espalier/core/error.h>
#include <espalier/core/files.h>
#include <espalier/experiments/analysis/check.h>
#include <espalier/experiments/analysis/report.h>
#include <espalier/experiments/comparison/compare_studies.h>
#include <espalier/experiments/declaration/experiment.h>
#include <espalier/experiments/export/export_study.h>
#include <espalier/experiments/runner/run_experiment.h>
#include <espalier/experiments/runner/summary_table.h>

namespace espalier {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct RunArguments {
  std::string file, out;
  std::vector<std::string> settings;
  int jobs = 0;
  bool quiet = false, json = false;
};

std::string duration(double seconds) {
  if (seconds < 90) return fmt::format("{:.0f} s", std::ceil(seconds));
  return fmt::format("{:.0f} min", std::ceil(seconds / 60));
}

std::string progress_text(const ExperimentProgress& progress) {
  if (!progress.posterior.empty()) return progress.posterior;
  return fmt::format("{} of {} runs done{}{}", progress.done, progress.runs,
                     progress.failed > 0 ? fmt::format(", {} failed", progress.failed) : "",
                     progress.seconds_left ? ", " + duration(*progress.seconds_left) + " left" : "");
}

void print_outcome(const ExperimentOutcome& outcome, const fs::path& directory, double seconds) {
  fmt::print("{}", summary_table(outcome));
  std::size_t left = 0;
  for (const RunRow& row : outcome.rows) left += row.status == "left";
  if (left > 0)
    fmt::print("stopped with {} of {} runs left: the same command goes on\n", left, outcome.rows.size());
  else
    fmt::print("{} runs in {} ({}); espalier experiment report {}\n", outcome.rows.size(),
               (directory / "results.csv").string(), duration(seconds), directory.string());
}

/// The counts of runs and the numbers of each that is done.
nlohmann::ordered_json outcome_to_json(const ExperimentOutcome& outcome, const fs::path& directory,
                                       double seconds) {
  nlohmann::ordered_json json = {{"directory", directory.string()}, {"seconds", seconds}};
  for (const char* status : {"done", "failed", "left"})
    json[status] = std::count_if(outcome.rows.begin(), outcome.rows.end(),
                                 [&](const RunRow& row) { return row.status == status; });
  json["runs"] = nlohmann::ordered_json::array();
  for (const RunRow& row : outcome.rows) {
    nlohmann::ordered_json run = {{"run", row.run}, {"status", row.status}};
    for (const Row* columns : {&row.labels, &row.measured.results})
      for (const auto& [column, cell] : *columns) run[column] = cell;
    if (!row.error.empty()) run["error"] = row.error;
    json["runs"].push_back(run);
  }
  return json;
}

/// No result at all is a failure of the whole.
void check_outcome(const ExperimentOutcome& outcome, const fs::path& directory) {
  const auto has_failed = [](const RunRow& row) { return row.status == "failed"; };
  if (outcome.rows.empty() || !std::all_of(outcome.rows.begin(), outcome.rows.end(), has_failed)) return;
  print_message(fmt::format("{}: all {} runs failed, the first with: {}", directory.string(),
                            outcome.rows.size(), outcome.rows.front().error));
  throw CLI::RuntimeError(1);
}

void run_runs(const RunArguments& arguments) {
  Experiment experiment = read_experiment(arguments.file, arguments.settings);
  if (experiment.fits) experiment.fits->record.versions = recorded_versions();
  const fs::path directory =
      arguments.out.empty() ? fs::path("runs") / experiment.words.name : fs::path(arguments.out);
  ProgressLine line(arguments.quiet, 10);
  RunnerOptions options;
  options.jobs = arguments.jobs;
  options.stop_requested = is_interrupted;
  options.on_progress = [&line](const ExperimentProgress& progress) {
    line.show([&] { return progress_text(progress); });
  };
  watch_for_interrupt();
  const auto began = Clock::now();
  const ExperimentOutcome outcome = run_experiment(experiment, directory, options);
  line.end();
  const double seconds = std::chrono::duration<double>(Clock::now() - began).count();
  if (arguments.json)
    print_as_json(outcome_to_json(outcome, directory, seconds));
  else if (!arguments.quiet)
    print_outcome(outcome, directory, seconds);
  check_outcome(outcome, directory);
}

void make_report(const std::string& directory) {
  const fs::path page = write_report(directory, {recorded_versions()});
  fmt::print("{}\n", page.string());
}

void add_report_command(CLI::App& experiment) {
  CLI::App* command =
      experiment.add_subcommand("report", "Draw the plots and the page of an experiment's runs");
  const auto directory = std::make_shared<std::string>();
  command->add_option("directory", *directory, "directory of an experiment: runs/NAME")->required();
  command->callback([directory] { make_report(*directory); });
}

struct CheckArguments {
  std::string directory, expected;
};

/// What the experiment's own expectations were when it ran; else NAME.expected.toml among the bundled
/// experiments, for runs/NAME.
fs::path expected_for(const CheckArguments& arguments) {
  if (!arguments.expected.empty()) return arguments.expected;
  if (fs::path kept = kept_expectations(arguments.directory); fs::exists(kept)) return kept;
  const std::string name =
      fs::absolute(fs::path(arguments.directory) / ".").lexically_normal().parent_path().filename();
  return data_path("experiments/" + name + ".expected.toml");
}

void check_runs(const CheckArguments& arguments) {
  const auto checked = check_expectations(read_expectations(expected_for(arguments)), arguments.directory);
  std::size_t broken = 0;
  for (const CheckedExpectation& one : checked) {
    fmt::print("{}  {}: got {:.6g}\n", one.holds ? "holds " : "BROKEN", one.expectation.text(), one.got);
    broken += !one.holds;
  }
  if (broken == 0) return;
  print_message(
      fmt::format("{}: {} of {} expectations do not hold", arguments.directory, broken, checked.size()));
  throw CLI::RuntimeError(1);
}

void add_check_command(CLI::App& experiment) {
  CLI::App* command = experiment.add_subcommand("check", "Compare what was measured with what is expected");
  const auto arguments = std::make_shared<CheckArguments>();
  command->add_option("directory", arguments->directory, "directory of an experiment: runs/NAME")->required();
  command->add_option("expected", arguments->expected,
                      "expectations (default: experiments/NAME.expected.toml)");
  command->callback([arguments] { check_runs(*arguments); });
}

struct CompareArguments {
  std::string first, second, out;
};

void compare_two(const CompareArguments& arguments) {
  const StudyComparison comparison = compare_studies(arguments.first, arguments.second);
  const std::string page = comparison_as_markdown(comparison);
  if (arguments.out.empty()) {
    fmt::print("{}", page);
    return;
  }
  const fs::path out = arguments.out;
  make_directory(out);
  write_file_atomically(out / "compare.md", page);
  write_file_atomically(out / "compare.csv", to_csv(comparison.table));
  fmt::print("{}\n", (out / "compare.md").string());
}

void add_study_comparison(CLI::App& experiment) {
  CLI::App* command = experiment.add_subcommand(
      "compare", "Say whether one of two finished experiments is better on the targets that both have");
  const auto arguments = std::make_shared<CompareArguments>();
  command->add_option("first", arguments->first, "directory of an experiment: runs/NAME")->required();
  command->add_option("second", arguments->second, "that of another one")->required();
  command->add_option("-o,--output", arguments->out,
                      "directory for compare.md and compare.csv (default: the table is printed)");
  command->callback([arguments] { compare_two(*arguments); });
}

struct ExportArguments {
  std::string directory, format, out;
};

void add_study_export(CLI::App& experiment) {
  CLI::App* command = experiment.add_subcommand(
      "export", "Write the runs of fits for tools that compare optimisers: IOHanalyzer, COCO's cocopp");
  const auto arguments = std::make_shared<ExportArguments>();
  command->add_option("directory", arguments->directory, "directory of an experiment: runs/NAME")->required();
  command->add_option("--format", arguments->format, "iohprofiler or coco")
      ->required()
      ->check(CLI::IsMember(export_formats()));
  command->add_option("-o,--output", arguments->out, "directory to make: a folder a method")->required();
  command->callback([arguments] {
    for (const fs::path& folder : export_study(arguments->directory, arguments->format, arguments->out))
      fmt::print("{}\n", folder.string());
  });
}

void add_run_command(CLI::App& experiment) {
  CLI::App* command = experiment.add_subcommand("run", "Run what is left of an experiment");
  const auto arguments = std::make_shared<RunArguments>();
  command->add_option("file", arguments->file, "the experiment: a TOML file (see experiments/)")->required();
  command->add_option("-o,--output", arguments->out,
                      "directory to make, or to go on in (default: runs/NAME)");
  command
      ->add_option("--set", arguments->settings,
                   "replace keys of the experiment's [fits], [pictures] or [growth]: 'seconds=2' 'seeds=[1]'")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--jobs", arguments->jobs, "runs at once; 0: one per processor")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  command->add_flag("--quiet", arguments->quiet, "print nothing but errors");
  add_json_flag(*command, arguments->json);
  command->callback([arguments] { run_runs(*arguments); });
}

}  // namespace

void add_experiment_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("experiment", "Run, report, check, compare and export experiments declared as data");
  command->require_subcommand(1);
  add_run_command(*command);
  add_report_command(*command);
  add_check_command(*command);
  add_study_comparison(*command);
  add_study_export(*command);
}

}  // namespace espalier
