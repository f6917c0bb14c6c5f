// espalier fit: fits a tree to pictures. Options become a record, the fit runs, its progress is shown.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <espalier/app/commands/commands.h>
#include <espalier/app/options/json_output.h>
#include <espalier/app/options/long_work.h>
#include <espalier/app/options/messages.h>
#include <espalier/app/options/option_names.h>
#include <espalier/app/options/record_options.h>
#include <espalier/app/options/run_options.h>
#include <espalier/app/version.h>
#include <espalier/core/data_path.h>
#include <espalier/core/field_error.h>
#include <espalier/fitting/run/fit.h>
#include <espalier/fitting/run/full_size.h>
#include <espalier/fitting/run/run_pictures.h>
#include <espalier/fitting/starts/roomy_budget.h>
#include <espalier/models/models.h>

namespace espalier {

namespace {

namespace fs = std::filesystem;

constexpr const char* kDefaultPicture = "targets/fir.png";

struct FitArguments {
  RecordWords words;
  std::string image, out, resume, repeat;
  std::vector<std::string> pictures;  ///< of the run to resume or repeat
  int threads = 0;
  bool quiet = false, json = false;
};

std::string progress_text(const FitProgress& progress) {
  const std::string left =
      progress.seconds_left ? fmt::format(", {:.0f} s left", std::ceil(*progress.seconds_left)) : "";
  const std::string branches =
      progress.branch_steps > 0 ? fmt::format(", {} branch steps", progress.branch_steps) : "";
  return fmt::format("{} evaluations{}, best fitness {:.4f}{}", progress.evaluations, branches,
                     progress.best_fitness, left);
}

/// The bundled picture, from the working directory or else from the sources.
fs::path default_picture() {
  std::error_code error;
  return fs::exists(kDefaultPicture, error) ? fs::path(kDefaultPicture) : data_path(kDefaultPicture);
}

/// The picture without an angle, then those with one.
std::vector<ViewRecord> views_of(const FitArguments& arguments, const std::vector<ViewRecord>& given) {
  std::vector<ViewRecord> views = given;
  if (!arguments.image.empty()) views.insert(views.begin(), ViewRecord{arguments.image, {}});
  if (views.empty()) views.push_back({default_picture(), {}});
  std::error_code error;
  for (ViewRecord& view : views) view.picture = fs::absolute(view.picture, error);
  return views;
}

/// The time has a default; given alone, a number of evaluations replaces it.
void set_budget(const RecordWords& words, FitBudget& budget) {
  if (words.has("budget.evaluations") && !words.has("budget.seconds")) budget.seconds = 0;
}

/// Without a limit of time, refinement needs one of its own.
void set_branch_rounds(const RecordWords& words, FitRecord& record) {
  constexpr long kWithoutTime = 24;
  long& rounds = record.budget.branch_rounds;
  if (!words.has("budget.branch_rounds"))
    rounds = record.fit_seeds > 1 ? 0 : record.budget.seconds > 0 ? kWhileTimeLasts : kWithoutTime;
  else if (rounds != 0 && record.fit_seeds > 1)
    throw_field_error("budget.branch_rounds",
                      "got {} with {} {}, expected one seed: branches belong to one tree", rounds,
                      option_of("fit_seeds"), record.fit_seeds);
}

FitRecord new_record(const FitArguments& arguments) {
  const RecordWords& words = arguments.words;
  FitRecord record = default_request();
  apply_words(words, record);
  record.views = views_of(arguments, record.views);
  set_budget(words, record.budget);
  // The bundled presets are starts for the parametric model alone.
  if (record.model != FitRecord{}.model) {
    if (!words.has("start")) record.start = "defaults";
    if (!words.has("growth.max_stems") && !words.has("growth.max_leaves"))
      record.growth = roomy_budget(model_by_name(record.model), record.seed, record.growth);
  }
  set_branch_rounds(words, record);
  return record;
}

std::string version_in(const std::map<std::string, std::string>& versions) {
  const auto of = [&](const char* name) {
    const auto found = versions.find(name);
    return found == versions.end() ? "unknown" : found->second;
  };
  return fmt::format("{} (commit {})", of("espalier"), of("commit"));
}

/// Another program may grow, draw and search otherwise.
void warn_of_another_program(const FitArguments& arguments, const FitRecord& record) {
  const std::string then = version_in(record.versions), now = version_in(recorded_versions());
  if (then == now || arguments.quiet) return;
  print_warning(fmt::format("{}: was run by espalier {}, and this is {}: its trees may come out otherwise",
                            arguments.resume + arguments.repeat, then, now));
}

/// The record in a run's directory, with the limits of this command line where it gives any: time or
/// evaluations, given alone, leave no limit to the other.
FitRecord resumed_record(const FitArguments& arguments) {
  const RecordWords& words = arguments.words;
  check_run_directory(arguments.resume);
  FitRecord record = read_record(fs::path(arguments.resume) / "run.toml").record;
  warn_of_another_program(arguments, record);
  find_pictures(record, arguments.resume, arguments.pictures);
  if (words.has("budget.evaluations") || words.has("budget.seconds"))
    record.budget.evaluations = 0, record.budget.seconds = 0;
  apply_words(words, record);
  return record;
}

/// The record of a run, to be repeated for as many evaluations as that run made.
FitRecord repeated_record(const FitArguments& arguments) {
  check_run_directory(arguments.repeat);
  auto [record, outcome] = read_record(fs::path(arguments.repeat) / "run.toml");
  warn_of_another_program(arguments, record);
  find_pictures(record, arguments.repeat, arguments.pictures);
  for (ViewRecord& view : record.views) view.kept_as.clear();  // it is a run of its own
  if (outcome)
    record.budget = {.evaluations = outcome->evaluations,
                     .seconds = 0,
                     .target_fitness = 0,
                     .branch_rounds = outcome->branch_rounds,
                     .finish_from = outcome->finish_from};
  return record;
}

/// runs/fir-1, or runs/fir-1-2 where that is taken.
fs::path unused_directory(const FitRecord& record) {
  const std::string stem = fmt::format("{}-{}", record.views.front().picture.stem().string(), record.seed);
  fs::path directory = fs::path("runs") / stem;
  std::error_code error;
  for (int i = 2; fs::exists(directory, error); ++i)
    directory = fs::path("runs") / fmt::format("{}-{}", stem, i);
  return directory;
}

void print_result(const FitResult& result, const FitRecord& record, const fs::path& directory) {
  fmt::print("fitness {:.4f}, IoU {:.4f}, tolerant IoU {:.4f}, outline IoU {:.4f}, gap IoU {:.4f}\n",
             result.fitness, result.metrics["iou"], result.metrics["tolerant_iou"],
             result.metrics["outline_iou"], result.metrics["gap_iou"]);
  fmt::print("{} evaluations in {:.1f} s with {} over {} parameters, stopped by {}; best start: {}\n",
             result.evaluations, result.seconds, record.optimizer, result.dimension,
             name_of(result.stopped_by), result.best_start);
  if (const auto& full = result.full_size_metrics)
    fmt::print("at {} px: IoU {:.4f}, tolerant IoU {:.4f}, outline IoU {:.4f}, gap IoU {:.4f}\n",
               std::max(kFullSizePx, record.target.size_px), (*full)["iou"], (*full)["tolerant_iou"],
               (*full)["outline_iou"], (*full)["gap_iou"]);
  if (result.failures.count > 0)
    print_message(fmt::format("{} candidates failed and counted as the worst; the first: {}",
                              result.failures.count, result.failures.first));
  if (result.branch_steps > 0)
    fmt::print("{} branches refined in {} steps\n", result.overrides.nodes.size(), result.branch_steps);
  if (result.portrait && result.resemblances.size() > 1)
    fmt::print(
        "resembles {} ({:.2f} standard deviations away; next {}, {:.2f}); {:.0f} % of the plant seen is "
        "wood\n",
        result.resemblances[0].species, result.resemblances[0].departure, result.resemblances[1].species,
        result.resemblances[1].departure, 100 * result.portrait->visible_wood);
  fmt::print("files: {} (best.toml, best.png, overlay.png, convergence.png, summary.json)\n",
             directory.string());
}

void run_fit(const FitArguments& arguments) {
  if (!arguments.pictures.empty() && arguments.resume.empty() && arguments.repeat.empty())
    throw_input_error("--picture: got neither --resume nor --repeat, expected the run whose picture it is");
  ProgressLine line(arguments.quiet, 5);
  FitExecution options;
  options.threads = arguments.threads;
  options.resume = !arguments.resume.empty();
  options.stop_requested = is_interrupted;
  options.on_progress = [&line](const FitProgress& progress) {
    line.show([&] { return progress_text(progress); });
  };
  if (!arguments.quiet) options.on_warning = print_warning;
  FitRecord record = options.resume              ? resumed_record(arguments)
                     : !arguments.repeat.empty() ? repeated_record(arguments)
                                                 : new_record(arguments);
  record.versions = recorded_versions();
  const fs::path directory = options.resume          ? fs::path(arguments.resume)
                             : arguments.out.empty() ? unused_directory(record)
                                                     : fs::path(arguments.out);
  watch_for_interrupt();
  const FitResult result = fit(record, directory, options);
  line.end();
  if (arguments.json)
    print_summary_json(directory, "summary.json");
  else if (!arguments.quiet)
    print_result(result, record, directory);
}

void add_run_options(CLI::App& command, FitArguments& arguments) {
  command.option_defaults()->group("The run");
  CLI::Option* out = command.add_option(
      "-o,--output", arguments.out,
      "directory to make (default: runs/IMAGE-SEED); there, best.toml is the tree, archive/ holds others "
      "nearly as good");
  command.add_option("--threads", arguments.threads, "0: one per processor; changes the speed only")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  command.add_flag("--quiet", arguments.quiet, "print nothing but errors");
  add_json_flag(command, arguments.json);
  CLI::Option* resume =
      command.add_option("--resume", arguments.resume, "go on with the run in this directory")->excludes(out);
  CLI::Option* repeat =
      command.add_option("--repeat", arguments.repeat, "repeat the run in this directory")->excludes(resume);
  add_picture_option(command, arguments.pictures);
  for (CLI::Option* option : {resume, repeat}) option->excludes(command.get_option("image"));
  exclude_record_options(command, *resume, *repeat);
}

}  // namespace

void add_fit_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("fit", "Fit a tree to a picture, or to pictures from several sides");
  const auto arguments = std::make_shared<FitArguments>();
  command->add_option("image", arguments->image, "picture of a tree (default: the bundled fir)");
  add_record_options(*command, arguments->words);
  add_run_options(*command, *arguments);
  command->callback([arguments] { run_fit(*arguments); });
}

}  // namespace espalier
