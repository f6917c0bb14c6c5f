#include <algorithm>

#include <espalier/core/files.h>
#include <espalier/fitting/record/species_components.h>
#include <espalier/fitting/run/fit.h>
#include <espalier/fitting/run/fit_run.h>
#include <espalier/fitting/run/run_files.h>
#include <espalier/fitting/run/run_pictures.h>
#include <espalier/fitting/search/fit_objective.h>
#include <espalier/fitting/starts/fit_plan.h>
#include <espalier/fitting/task/growth_memory.h>
#include <espalier/fitting/task/record_task.h>
#include <espalier/machine/directory_lock.h>
#include <espalier/machine/memory.h>
#include <espalier/models/models.h>

namespace espalier {

namespace fs = std::filesystem;

namespace {

/// The record as it is kept: it names the model and the optimiser that the caller brought along.
FitRecord record_of(const FitRecord& given, const FitExecution& options) {
  FitRecord record = given;
  if (options.model) record.model = options.model->table().model;
  if (options.optimizer) record.optimizer = options.optimizer->name();
  return record;
}

/// An optimiser that no table holds checks its settings itself, in check_searches.
void check_given(const FitRecord& given, const FitExecution& options) {
  FitRecord record = given;
  if (options.optimizer) {
    record.optimizer = FitRecord{}.optimizer;
    record.optimizer_settings.clear();
  }
  check_record(record);
}

struct StopAtOnce : Observer {
  bool stop_requested() override { return true; }
};

struct NoScorer : Scorer {
  void score(std::span<const ParameterValues>, std::span<double> scores) override {
    std::fill(scores.begin(), scores.end(), 1.0);
  }
};

/// Lets the optimiser check objective and settings before anything is written: it stops before it begins.
void check_optimizer(const FitRecord& record, const Optimizer& optimizer, const Objective& objective) {
  StopAtOnce stop;
  optimizer.minimize(objective, record.optimizer_settings, {kUnlimited}, {}, record.seed, stop);
}

/// The same for each of the searches the run will make.
void check_searches(const FitRecord& record, const Optimizer& optimizer, const SearchSpace& space,
                    const std::optional<SpeciesSpace>& species) {
  NoScorer no_scorer;
  check_optimizer(record, optimizer, FitObjective(space, no_scorer));
  if (species) check_optimizer(record, optimizer, SpaceObjective(*species, {}, {}, no_scorer));
}

/// Nobody else works in the directory now, as somebody may have until now.
std::vector<std::string> enter(const fs::path& directory, const ParameterTable& table,
                               const FitExecution& options) {
  if (options.resume) return mend_run_directory(directory, table);
  check_new_directory(directory);
  remove_temporary_files(directory);
  return {};
}

}  // namespace

std::optional<SpeciesSpace> space_of(const FitRecord& record, const Model& model) {
  const int components = parse_search_space(record.space);
  if (components == 0) return std::nullopt;
  return bundled_species_space(model, components);
}

const Optimizer& optimizer_of(const FitRecord& record, const FitExecution& options) {
  return options.optimizer ? *options.optimizer : optimizer_by_name(record.optimizer);
}

FitResult fit(const FitRecord& given, const fs::path& directory, const FitExecution& options) {
  options.resume ? check_run_directory(directory) : check_new_directory(directory);
  check_given(given, options);
  check_growth_memory(given.growth, threads_of(options), machine_memory_bytes());
  FitRecord record = record_of(given, options);
  if (options.resume) find_pictures(record, directory);
  FitTask task = make_task(record, options.model);
  task.make_renderer = options.make_renderer;
  const ParameterTable& table = task.model->table();
  const std::optional<SpeciesSpace> species = space_of(record, *task.model);
  check_searches(record, optimizer_of(record, options),
                 make_search_space(table, table.defaults(), record.search), species);
  const FitPlan plan = plan_of(record, task);
  settle_branches(plan, task);
  record.freedom = plan.freedom;
  note_contents(record);
  const KeptFiles kept = files_to_keep(record, *task.model);
  record = kept.record;
  make_directory(directory);
  const DirectoryLock lock(directory);
  for (const std::string& damage : enter(directory, table, options)) options.on_warning(damage);
  begin_run_directory(directory, {.record = record, .task = task}, kept.files);
  read_kept_pictures(record, directory);
  for (const std::string& warning : task.warnings) options.on_warning(warning);
  return FitRun(record, task, plan, directory, options).run(species);
}

}  // namespace espalier
