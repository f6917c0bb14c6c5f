#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include <espalier/core/error.h>
#include <espalier/experiments/declaration/known_truth.h>
#include <espalier/experiments/declaration/target_files.h>
#include <espalier/experiments/runner/fit_runs.h>
#include <espalier/experiments/runner/kept_targets.h>
#include <espalier/experiments/runner/unseen_side.h>
#include <espalier/experiments/runner/unseen_trees.h>
#include <espalier/fitting/run/fit.h>
#include <espalier/fitting/run/run_files.h>
#include <espalier/fitting/run/run_pictures.h>
#include <espalier/fitting/task/record_task.h>
#include <espalier/models/models.h>

namespace espalier {

namespace fs = std::filesystem;

namespace {

/// One combination of the declaration's lists.
struct FitCell {
  std::string name;
  Row labels;
  KnownTree tree;  ///< the target's, where it is drawn from a species
  FitRecord record;
  int unseen_seeds = 0, siblings = 0, threads = 1;
};

/// A view of a record on disk with the picture's place as in `asked` where both are of one picture: the same
/// bytes by the same name. Runs of earlier versions do not know the bytes: their picture is where it was.
ViewRecord with_place_of(const ViewRecord& asked, ViewRecord on_disk) {
  if (on_disk.content && on_disk.picture.filename() == asked.picture.filename() &&
      content_of(asked.file()) == *on_disk.content)
    on_disk.picture = asked.picture;
  on_disk.content = asked.content;
  on_disk.kept_as = asked.kept_as;
  return on_disk;
}

KeptFiles files_of(const FitRecord& record) { return files_to_keep(record, model_by_name(record.model)); }

/// Whether a record on disk asks for what `request` does: it also knows its target's hash, its versions, what
/// freedom its kind of tree has, what its pictures hold and where its copies of other files are.
bool same_request(FitRecord on_disk, FitRecord request) {
  KeptFiles kept = files_of(on_disk), asked = files_of(request);
  if (kept.files != asked.files) return false;
  on_disk = std::move(kept.record), request = std::move(asked.record);
  for (FitRecord* record : {&on_disk, &request}) record->target_hash.clear(), record->versions.clear();
  for (std::size_t i = 0; i < std::min(on_disk.views.size(), request.views.size()); ++i)
    on_disk.views[i] = with_place_of(request.views[i], on_disk.views[i]);
  if (request.freedom == kFreedomOfKind) request.freedom = on_disk.freedom;
  return record_to_toml(on_disk, std::nullopt) == record_to_toml(request, std::nullopt);
}

/// True where `directory` holds this fit, begun before; one that died before its record was written is
/// removed.
bool can_resume(const fs::path& directory, const FitRecord& record) {
  if (!fs::exists(directory / "run.toml")) {
    fs::remove_all(directory);
    return false;
  }
  if (!same_request(read_record(directory / "run.toml").record, record))
    throw_input_error("{}: got the run of another record, expected that of this experiment",
                      (directory / "run.toml").string());
  return true;
}

double share_done(const FitProgress& progress, const FitBudget& budget) {
  double share = 0;
  if (budget.seconds > 0) share = progress.seconds / budget.seconds;
  if (budget.evaluations > 0)
    share =
        std::max(share, static_cast<double>(progress.evaluations) / static_cast<double>(budget.evaluations));
  return std::min(share, 1.0);
}

void append(Row& row, const std::string& prefix, const UnseenScore& score) {
  row.emplace_back(prefix + "fitness", table_number(score.fitness));
  row.emplace_back(prefix + "iou", table_number(score.iou));
}

void append(Row& row, const SideScores& scores) {
  for (const SideColumn& column : kSideColumns)
    row.emplace_back(column.name, table_number(scores.*column.value));
}

Measured measure(const FitResult& result, const FitCell& cell) {
  Measured measured;
  measured.results = {{"fitness", table_number(result.fitness)}};
  for (std::size_t row = 0; row < kMetricCount; ++row) {
    measured.results.emplace_back(kMetrics[row].name, table_cell(result.metrics.values[row]));
  }
  measured.results.emplace_back("evaluations", fmt::format("{}", result.evaluations));
  measured.results.emplace_back("branch_steps", fmt::format("{}", result.branch_steps));
  measured.results.emplace_back("stopped_by", name_of(result.stopped_by));
  for (const PlantMeasure& measure : kPlantMeasures)
    measured.results.emplace_back(measure.name,
                                  result.portrait ? table_number((*result.portrait).*measure.value) : "");
  if (cell.unseen_seeds > 0) {
    const UnseenTrees unseen(cell.record, cell.unseen_seeds);
    append(measured.results, "unseen_", unseen.score(result.values));
    if (!cell.tree.species.empty())
      append(measured.results, "truth_", score_truth(cell.record, cell.tree.species, cell.unseen_seeds));
  }
  if (cell.siblings > 0 && !cell.tree.species.empty())
    append(measured.results, score_sides(cell.record, result, cell.tree, cell.siblings));
  measured.times = {{"seconds", table_number(result.seconds)},
                    {"evaluations", fmt::format("{}", result.evaluations)},
                    {"branch_steps", fmt::format("{}", result.branch_steps)}};
  return measured;
}

/// Says of the pictures that the experiment keeps one copy for many runs.
FitRecord record_in(const fs::path& directory, const FitCell& cell) {
  FitRecord record = cell.record;
  for (ViewRecord& view : record.views) view.kept_as = view.copy.lexically_relative(fs::absolute(directory));
  return record;
}

std::optional<Measured> run_cell(const FitCell& cell, const fs::path& directory, const RunContext& context) {
  const FitRecord record = record_in(directory, cell);
  FitExecution options;
  options.threads = cell.threads;
  options.resume = can_resume(directory, record);
  options.stop_requested = context.stop_requested;
  options.on_progress = [&](const FitProgress& progress) {
    context.on_progress(share_done(progress, record.budget));
  };
  const FitResult result = fit(record, directory, options);
  if (result.stopped_by == FitStop::interrupted) return std::nullopt;
  return measure(result, cell);
}

/// Names of directories hold the target, the seed and what else varies.
void add_label(FitCell& cell, const std::string& column, const std::string& label, bool in_name) {
  cell.labels.emplace_back(column, label);
  if (in_name) cell.name += (cell.name.empty() ? "" : ",") + label;
}

/// Every cell with every one of these values, which `set` enters and names.
template <typename Value, typename Set>
std::vector<FitCell> expand(const std::vector<FitCell>& cells, const std::string& column,
                            const std::vector<Value>& values, Set set) {
  const bool in_name = values.size() > 1 || column == "target" || column == "seed";
  std::vector<FitCell> expanded;
  for (const FitCell& cell : cells)
    for (const Value& value : values) {
      expanded.push_back(cell);
      add_label(expanded.back(), column, set(expanded.back(), value), in_name);
    }
  return expanded;
}

std::string set_target(FitCell& cell, const ReadyTarget& target) {
  cell.tree = {target.declaration.species, target.declaration.seed};
  cell.record.views = target.views;
  if (target.height_m) cell.record.height_m = target.height_m;
  return target.declaration.name;
}

std::string set_optimizer(FitCell& cell, const OptimizerDeclaration& optimizer) {
  cell.record.optimizer = optimizer.name;
  cell.record.optimizer_settings = optimizer.settings;
  return optimizer.label;
}

std::string set_objective(FitCell& cell, const std::string& objective) {
  return cell.record.objective = objective;
}

std::string set_space(FitCell& cell, const SpaceDeclaration& space) {
  cell.record.model = space.model;
  cell.record.growth = space.growth;
  cell.record.search = space.search;
  cell.record.space = space.first;
  return space.label;
}

std::string set_start(FitCell& cell, const std::string& start) {
  cell.record.start = start_of_model(start, cell.record.model);
  return start;
}

std::string set_trained(FitCell& cell, bool trained) {
  cell.record.train_to_target = trained;
  return trained ? "trained" : "plain";
}

std::string set_seed(FitCell& cell, Seed seed) {
  cell.record.seed = seed;
  return fmt::format("{}", seed);
}

/// The label stays as it was declared: what is left out differs from target to target.
void leave_out_truth(FitCell& cell) {
  cell.record.start = start_beside_truth(cell.record.start, cell.tree.species, cell.record.model);
}

std::vector<FitCell> all_cells(const FitsDeclaration& fits, const std::vector<ReadyTarget>& targets) {
  std::vector<FitCell> cells{{.record = fits.record,
                              .unseen_seeds = fits.unseen_seeds,
                              .siblings = fits.siblings,
                              .threads = fits.threads}};
  cells = expand(cells, "target", targets, set_target);
  cells = expand(cells, "optimizer", fits.optimizers, set_optimizer);
  cells = expand(cells, "objective", fits.objectives, set_objective);
  cells = expand(cells, "space", fits.spaces, set_space);
  cells = expand(cells, "start", fits.starts, set_start);
  if (fits.exclude_truth) std::ranges::for_each(cells, leave_out_truth);
  cells = expand(cells, "trained", fits.trained, set_trained);
  return expand(cells, "seed", fits.seeds, set_seed);
}

/// Names that stand for what the cell's labels say.
void add_runs(std::vector<FitCell> cells, Plan& plan) {
  plan.runs.reserve(cells.size());
  for (FitCell& each : cells) {
    const auto cell = std::make_shared<const FitCell>(std::move(each));
    plan.runs.push_back(
        {directory_name(cell->name), cell->labels,
         [cell](const fs::path& run, const RunContext& context) { return run_cell(*cell, run, context); }});
  }
  make_names_unique(plan);
}

}  // namespace

Plan name_fits(const FitsDeclaration& fits) {
  std::vector<ReadyTarget> targets;
  targets.reserve(fits.targets.size());
  for (const TargetDeclaration& target : fits.targets) targets.push_back({target, target.views, {}});
  Plan plan;
  add_runs(all_cells(fits, targets), plan);
  return plan;
}

Plan plan_fits(const FitsDeclaration& fits, const fs::path& directory) {
  Plan plan;
  plan.label_columns = {"target", "optimizer", "objective", "space", "start", "trained", "seed"};
  plan.threads_per_run = fits.threads;
  plan.result_columns = {"fitness"};
  for (const Metric& metric : kMetrics) plan.result_columns.emplace_back(metric.name);
  for (const char* column : {"evaluations", "branch_steps", "stopped_by"})
    plan.result_columns.emplace_back(column);
  for (const PlantMeasure& measure : kPlantMeasures) plan.result_columns.emplace_back(measure.name);
  for (const char* column : {"unseen_fitness", "unseen_iou", "truth_fitness", "truth_iou"})
    plan.result_columns.emplace_back(column);
  for (const SideColumn& column : kSideColumns) plan.result_columns.emplace_back(column.name);
  plan.time_columns = {"seconds", "evaluations", "branch_steps"};
  add_runs(all_cells(fits, keep_targets(fits, directory)), plan);
  return plan;
}

}  // namespace espalier
