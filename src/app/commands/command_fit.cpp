// espalier fit: fits a tree to pictures. Options become a record, the fit runs, its progress is shown.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>

#include <espalier/app/commands/commands.h>
#include <espalier/app/options/long_work.h>
#include <espalier/app/version.h>
#include <espalier/core/data_path.h>
#include <espalier/core/error.h>
#include <espalier/fitting/run/fit.h>
#include <espalier/fitting/run/full_size.h>
#include <espalier/models/models.h>

namespace espalier {

namespace {

namespace fs = std::filesystem;

constexpr const char* kDefaultPicture = "targets/fir.png";

struct FitArguments {
  FitRecord record;
  std::string image, out, resume, repeat;
  std::vector<std::string> views, free, fixed, settings;
  std::string separation = "auto", tree_side = "auto", stages = to_string(FitStages{}),
              kind = name_of(KindChoice::automatic);
  double height_m = 0;
  int threads = 0;
  bool quiet = false, all_trees = false;
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

/// "name=value" with a number for a value.
std::pair<std::string, double> parse_assignment(const std::string& text, const char* option) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw_input_error("{}: got '{}', expected name=value", option, text);
  const std::string number = text.substr(equals + 1);
  std::size_t used = 0;
  double value = NAN;
  try {
    value = std::stod(number, &used);
  } catch (const std::exception&) {  // no number, or out of range
  }
  if (used != number.size() || number.empty() || !std::isfinite(value))
    throw_input_error("{}: {} got '{}', expected a finite number", option, text.substr(0, equals), number);
  return {text.substr(0, equals), value};
}

std::vector<ViewRecord> views_of(const FitArguments& arguments) {
  std::vector<ViewRecord> views;
  if (!arguments.image.empty()) views.push_back({arguments.image, {}});
  for (const std::string& text : arguments.views) views.push_back(parse_view(text));
  if (views.empty()) views.push_back({default_picture(), {}});
  std::error_code error;
  for (ViewRecord& view : views) view.picture = fs::absolute(view.picture, error);
  return views;
}

/// --seconds has a default; given alone, --evaluations or --target-fitness replace it.
void set_budget(const CLI::App& command, FitBudget& budget) {
  if (command.count("--evaluations") > 0) {
    if (budget.evaluations < 1)
      throw_input_error("--evaluations: got {}, expected a whole number from 1", budget.evaluations);
    if (command.count("--seconds") == 0) budget.seconds = 0;
  }
  if (command.count("--seconds") > 0 && !(budget.seconds > 0))
    throw_input_error("--seconds: got {}, expected a positive number", budget.seconds);
  if (command.count("--target-fitness") > 0 && !(budget.target_fitness > 0))
    throw_input_error("--target-fitness: got {}, expected a number above 0, at most 1",
                      budget.target_fitness);
}

/// Without a limit of time, refinement needs one of its own.
void set_branch_rounds(const CLI::App& command, FitRecord& record) {
  constexpr long kWithoutTime = 24;
  long& rounds = record.budget.branch_rounds;
  if (command.count("--branch-rounds") == 0)
    rounds = record.fit_seeds > 1 ? 0 : record.budget.seconds > 0 ? kWhileTimeLasts : kWithoutTime;
  else if (rounds < 0)
    throw_input_error("--branch-rounds: got {}, expected a whole number from 0", rounds);
  else if (rounds > 0 && record.fit_seeds > 1)
    throw_input_error(
        "--branch-rounds: got {} with --fit-seeds {}, expected one seed: branches belong to one tree", rounds,
        record.fit_seeds);
}

/// Plants of other models cannot be thinned: a budget that their default plant keeps with room to spare.
GrowthBudget roomy_budget(const std::string& model_name, Seed seed, GrowthBudget budget) {
  constexpr double kRoom = 3;
  const Model& model = model_by_name(model_name);
  Plant plant;
  if (!model.generate(model.table().defaults(), seed, {}, plant).grown) return budget;
  budget.max_stems = std::max(budget.max_stems, kRoom * static_cast<double>(plant.stems.size()));
  budget.max_leaves = std::max(budget.max_leaves, kRoom * static_cast<double>(plant.leaves.size()));
  return budget;
}

FitRecord new_record(const CLI::App& command, const FitArguments& arguments) {
  FitRecord record = arguments.record;
  record.views = views_of(arguments);
  record.search.free = arguments.free;
  for (const std::string& text : arguments.fixed) record.search.fixed.insert(parse_assignment(text, "--fix"));
  for (const std::string& text : arguments.settings)
    record.optimizer_settings.insert(parse_assignment(text, "--set-optimizer"));
  record.target.method = parse_separation_method(arguments.separation);
  record.target.side = parse_tree_side(arguments.tree_side);
  record.target.one_tree = !arguments.all_trees;
  record.stages = parse_stages(arguments.stages);
  const auto kind = value_named<KindChoice>(arguments.kind);
  if (!kind)
    throw_input_error("--kind: got '{}', expected {}", arguments.kind,
                      fmt::join(names_of<KindChoice>(), ", "));
  record.kind = *kind;
  if (command.count("--height") > 0) record.height_m = arguments.height_m;
  set_budget(command, record.budget);
  // The bundled presets are starts for the parametric model alone.
  if (record.model != FitRecord{}.model) {
    if (command.count("--start") == 0) record.start = "defaults";
    if (command.count("--max-stems") + command.count("--max-leaves") == 0)
      record.growth = roomy_budget(record.model, record.seed, record.growth);
  }
  set_branch_rounds(command, record);
  return record;
}

/// The record in a run's directory, with the limits of this command line where it gives any.
FitRecord resumed_record(const CLI::App& command, const FitArguments& arguments) {
  check_run_directory(arguments.resume);
  FitRecord record = read_record(fs::path(arguments.resume) / "run.toml").record;
  FitBudget given = arguments.record.budget;
  set_budget(command, given);
  if (command.count("--evaluations") + command.count("--seconds") > 0)
    record.budget.evaluations = given.evaluations, record.budget.seconds = given.seconds;
  if (command.count("--target-fitness") > 0) record.budget.target_fitness = given.target_fitness;
  return record;
}

/// The record of a run, to be repeated for as many evaluations as that run made.
FitRecord repeated_record(const std::string& directory) {
  check_run_directory(directory);
  auto [record, outcome] = read_record(fs::path(directory) / "run.toml");
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
             result.fitness, result.metrics.iou, result.metrics.tolerant_iou, result.metrics.outline_iou,
             result.metrics.gap_iou);
  fmt::print("{} evaluations in {:.1f} s with {} over {} parameters, stopped by {}; best start: {}\n",
             result.evaluations, result.seconds, record.optimizer, result.dimension,
             name_of(result.stopped_by), result.best_start);
  if (const auto& full = result.full_size_metrics)
    fmt::print("at {} px: IoU {:.4f}, tolerant IoU {:.4f}, outline IoU {:.4f}, gap IoU {:.4f}\n",
               std::max(kFullSize_px, record.target.size_px), full->iou, full->tolerant_iou,
               full->outline_iou, full->gap_iou);
  if (result.failures.count > 0)
    fmt::print(stderr, "{} candidates failed and counted as the worst; the first: {}\n",
               result.failures.count, result.failures.first);
  if (result.branch_steps > 0)
    fmt::print("{} branches refined in {} steps\n", result.overrides.nodes.size(), result.branch_steps);
  if (!result.certainty.empty()) fmt::print("{}\n", result.certainty);
  fmt::print("files: {} (best.toml, best.png, overlay.png, convergence.png, summary.json)\n",
             directory.string());
}

void run_fit(const CLI::App& command, const FitArguments& arguments) {
  ProgressLine line(arguments.quiet, 5);
  FitOptions options;
  options.threads = arguments.threads;
  options.resume = !arguments.resume.empty();
  options.stop_requested = is_interrupted;
  options.on_progress = [&line](const FitProgress& progress) {
    line.show([&] { return progress_text(progress); });
  };
  if (!arguments.quiet)
    options.on_warning = [](const std::string& text) { fmt::print(stderr, "espalier: warning: {}\n", text); };
  FitRecord record = options.resume              ? resumed_record(command, arguments)
                     : !arguments.repeat.empty() ? repeated_record(arguments.repeat)
                                                 : new_record(command, arguments);
  record.versions = recorded_versions();
  const fs::path directory = options.resume          ? fs::path(arguments.resume)
                             : arguments.out.empty() ? unused_directory(record)
                                                     : fs::path(arguments.out);
  watch_for_interrupt();
  const FitResult result = fit(record, directory, options);
  line.end();
  if (!arguments.quiet) print_result(result, record, directory);
}

void add_target_options(CLI::App& command, FitArguments& arguments) {
  command.add_option("image", arguments.image, "picture of a tree (default: the bundled fir)");
  command.add_option(
      "--views", arguments.views,
      "more pictures: FILE:AZIMUTH,ELEVATION[,FIELD_OF_VIEW], in degrees; 0,0 is the front view");
  command.add_option("--size", arguments.record.target.size_px, "side of the masks, px")
      ->capture_default_str();
  command.add_option("--height", arguments.height_m, "height of the tree, m (default: a nominal 10)");
  command.add_option("--separation", arguments.separation, "auto, alpha, luminance or background")
      ->capture_default_str();
  command.add_flag("--all-trees", arguments.all_trees,
                   "fit several trees of a picture as one (default: the largest alone)");
  command.add_option("--tree-side", arguments.tree_side, "auto, light or dark")->capture_default_str();
}

void add_search_options(CLI::App& command, FitArguments& arguments) {
  FitRecord& record = arguments.record;
  std::vector<std::string> methods;
  for (const auto& optimizer : all_optimizers()) methods.push_back(optimizer->name());
  command
      .add_option("--optimizer", record.optimizer,
                  fmt::format("method of the search: {}", fmt::join(methods, ", ")))
      ->capture_default_str();
  command.add_option("--set-optimizer", arguments.settings, "a setting of the method: name=value");
  record.objective = kFitObjective;
  command.add_option("--objective", record.objective, "weighted sum of measures to minimise")
      ->capture_default_str();
  command.add_option("--fit-seeds", record.fit_seeds, "trees grown per candidate, averaged")
      ->capture_default_str();
  command.add_option("--model", record.model, "weber_penn, or an L-system file NAME.lsys")
      ->capture_default_str();
  command.add_option("--start", record.start, "auto (all presets), defaults, or presets: NAME,NAME")
      ->capture_default_str();
  command.add_option("--space", record.space,
                     "species:K: search K coordinates of the species space first, then the parameters");
  command
      .add_option("--space-evaluations", record.space_evaluations,
                  "evaluations in the species space, at most")
      ->capture_default_str();
  command.add_option("--free", arguments.free, "parameters to search: a,b[1],curve*,default")->delimiter(',');
  command.add_option("--fix", arguments.fixed, "hold a parameter: name=value");
  command
      .add_option("--max-stems", record.growth.max_stems,
                  "stems a candidate may have; for an L-system at least 3 times those of its default plant")
      ->capture_default_str();
  command
      .add_option("--max-leaves", record.growth.max_leaves,
                  "leaves a candidate may have; for an L-system likewise")
      ->capture_default_str();
  command
      .add_option("--kind", arguments.kind,
                  "of tree: auto (read off the picture), any, leafy, leafless (never any leaves), palm")
      ->capture_default_str();
  command.add_flag("--train-to-target", record.train_to_target,
                   "keep the tree inside of the picture's outline: stems are shortened, bent, or cut (not "
                   "for L-systems)");
  command.add_option("--seed", record.seed, "of the search, and of the first tree")->capture_default_str();
}

void add_run_options(CLI::App& command, FitArguments& arguments) {
  FitBudget& budget = arguments.record.budget;
  command.add_option("--seconds", budget.seconds, "time to search")->capture_default_str();
  command.add_option("--evaluations", budget.evaluations, "stop after this many (alone: no limit of time)");
  command.add_option("--branch-rounds", budget.branch_rounds,
                     "rounds of branch by branch refinement after the search (default: as time allows, 24 "
                     "without a limit of time; 0: none)");
  command
      .add_option("--stages", arguments.stages,
                  "what to do after the starts are scored: names of search, tracing, branches and finish; a "
                  "--start that is not searched from is taken as it is, with its overrides")
      ->capture_default_str();
  command.add_option("--target-fitness", budget.target_fitness, "stop once the best is this good, 0..1");
  command.add_option(
      "--out", arguments.out,
      "directory to make (default: runs/IMAGE-SEED); there, best.toml is the tree, archive/ holds others "
      "nearly as good, parameters.svg says which parameters the picture determines");
  command.add_option("--threads", arguments.threads, "0: one per processor; changes the speed only")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  command.add_flag("--quiet", arguments.quiet, "print nothing but errors");
  CLI::Option* resume =
      command.add_option("--resume", arguments.resume, "go on with the run in this directory");
  CLI::Option* repeat = command.add_option("--repeat", arguments.repeat, "repeat the run in this directory");
  for (const char* other : {"image",
                            "--views",
                            "--out",
                            "--seed",
                            "--size",
                            "--height",
                            "--separation",
                            "--tree-side",
                            "--all-trees",
                            "--optimizer",
                            "--set-optimizer",
                            "--objective",
                            "--fit-seeds",
                            "--model",
                            "--start",
                            "--space",
                            "--space-evaluations",
                            "--free",
                            "--fix",
                            "--max-stems",
                            "--max-leaves",
                            "--kind",
                            "--train-to-target",
                            "--branch-rounds",
                            "--stages"}) {
    resume->excludes(command.get_option(other));
    if (std::string(other) != "--out") repeat->excludes(command.get_option(other));
  }
  for (const char* limit : {"--seconds", "--evaluations", "--target-fitness"})
    repeat->excludes(command.get_option(limit));
  repeat->excludes(resume);
}

}  // namespace

void add_fit_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("fit", "Fit a tree to a picture, or to pictures from several sides");
  const auto arguments = std::make_shared<FitArguments>();
  add_target_options(*command, *arguments);
  add_search_options(*command, *arguments);
  add_run_options(*command, *arguments);
  command->callback([command, arguments] { run_fit(*command, *arguments); });
}

}  // namespace espalier
