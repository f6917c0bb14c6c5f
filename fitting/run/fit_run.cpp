#include <algorithm>

#include <espalier/core/error.h>
#include <espalier/fitting/run/fit_run.h>
#include <espalier/machine/processors.h>

namespace espalier {

namespace fs = std::filesystem;

namespace {

constexpr double kRefreshSeconds = 3;   ///< the directory is at most this old, unless writing it is slow
constexpr double kRefreshShare = 0.02;  ///< of the time, at most, is spent writing the directory

/// A search that refinement had followed ends where it ended then.
long evaluation_limit(const FitRecord& record, const FitTask& task, const fs::path& directory,
                      const FitExecution& options) {
  const auto reached = reached_rounds(record, task, directory, options);
  return reached ? reached->search_evaluations : record.budget.evaluations;
}

EvaluationLog open_log(const fs::path& directory, const Replay& replay) {
  if (replay.on_batch) return EvaluationLog(replay.logged);
  return EvaluationLog(directory / "evaluations.bin");
}

}  // namespace

std::optional<BranchRounds> reached_rounds(const FitRecord& record, const FitTask& task,
                                           const fs::path& directory, const FitExecution& options) {
  std::optional<BranchRounds> reached =
      options.resume ? read_branch_rounds(directory, task.model->table()) : std::nullopt;
  if (reached && reached->search_limit != record.budget.evaluations) reached.reset();
  return reached;
}

int threads_of(const FitExecution& options) {
  return options.threads > 0 ? startable_threads(options.threads) : processors();
}

FitRun::FitRun(const FitRecord& record, const FitTask& task, const FitPlan& plan, const fs::path& directory,
               const FitExecution& options, Replay replay)
    : record_(record),
      threads_(threads_of(options)),
      task_(task),
      plan_(plan),
      sized_tasks_(record, task),
      directory_(directory),
      options_(options),
      state_{.record = record, .task = task, .kind = plan.kind},
      replay_(std::move(replay)),
      log_(open_log(directory, replay_)),
      plant_scorer_(task, threads_),
      scorer_(
          plant_scorer_, task.model->table(), log_,
          replay_.on_batch ? static_cast<long>(log_.logged().size())
                           : evaluation_limit(record, task, directory, options),
          [this] { return seconds(); }, [this](const ScoredBatch& batch) { on_scored(batch); }),
      renderer_(task.make_renderer()),
      given_overrides_(task.overrides) {}

double FitRun::seconds() const {
  return seconds_before_ + std::chrono::duration<double>(Clock::now() - live_since_).count();
}

bool FitRun::stop_requested() {
  if (state_.stopped_by) return true;
  const FitBudget& budget = record_.budget;
  const bool refining = !state_.branches.copies.empty();
  const double best_score = refining ? state_.best.score : scorer_.best().score;
  if (!refining && scorer_.limit_reached())
    state_.stopped_by = FitStop::evaluations;
  else if (budget.target_fitness > 0 && 1 - best_score >= budget.target_fitness)
    state_.stopped_by = FitStop::target_fitness;
  else if (scorer_.replaying())
    return false;
  else if (options_.stop_requested())
    state_.stopped_by = FitStop::interrupted;
  else if (budget.seconds > 0 && seconds() >= budget.seconds)
    state_.stopped_by = FitStop::time;
  return state_.stopped_by.has_value() || search_time_is_over();
}

void FitRun::refresh_directory() {
  const double began = seconds();
  if (state_.branches.copies.empty()) state_.best = scorer_.best();
  state_.evaluations = static_cast<long>(scorer_.evaluations());
  state_.seconds = began;
  state_.failures = plant_scorer_.failures();
  log_.sync();
  write_run_directory(directory_, state_);
  refreshed_at_ = seconds();
  refresh_cost_ = refreshed_at_ - began;
}

void FitRun::refresh_directory_if_old() {
  if (seconds() - refreshed_at_ > std::max(kRefreshSeconds, refresh_cost_ / kRefreshShare))
    refresh_directory();
}

void FitRun::report_progress() const {
  const FitBudget& budget = record_.budget;
  const double score = state_.branches.copies.empty() ? scorer_.best().score : state_.best.score;
  FitProgress progress{scorer_.evaluations(), state_.branches.steps, seconds(), 1 - score, {}};
  if (budget.seconds > 0) progress.seconds_left = std::max(0.0, budget.seconds - progress.seconds);
  if (budget.evaluations > 0 && budget.branch_rounds == 0) {
    const auto left = static_cast<double>(budget.evaluations - progress.evaluations);
    const double by_count = left * progress.seconds / static_cast<double>(progress.evaluations);
    progress.seconds_left = std::min(by_count, progress.seconds_left.value_or(by_count));
  }
  options_.on_progress(progress);
}

/// Of the same parameters and overrides, grown as if there were no picture to grow into.
MaskMetrics FitRun::untrained_metrics() {
  FitTask free = task_;
  free.growth.prune_to = nullptr;
  free.growth.train = false;
  return mean_metrics(free, draw_candidate(free, state_.best.values, *renderer_, best_overrides(state_)));
}

/// What the best tree looks like as a plant; nothing where it is none, beyond the growth budget.
void FitRun::portray_best() {
  const ChangeGraph changes(best_overrides(state_));
  GrowthSettings growth = task_.growth;
  growth.changes = &changes;
  Plant plant;
  if (!task_.model->generate(state_.best.values, best_seed(state_), growth, plant).grown) return;
  const View& front = record_.views.front().view;
  state_.portrait = portray(plant, front, best_overrides(state_));
  state_.sheet = plant_sheet(plant, task_.views.front(), front);
  state_.resemblances = resemblances_to_bundled(*task_.model, state_.best.values);
}

FitResult FitRun::finish() {
  if (state_.branches.copies.empty()) state_.best = scorer_.best();
  if (task_.growth.train) state_.metrics_untrained = untrained_metrics();
  if (!state_.branches.copies.empty())
    state_.full_size = look_at_full_size(record_, task_, sized_tasks_, state_.branches.best());
  portray_best();
  refresh_directory();
  const auto best_start =
      std::max_element(state_.starts.begin(), state_.starts.end(),
                       [](const auto& a, const auto& b) { return a.fitness < b.fitness; });
  return {.values = state_.best.values,
          .fitness = 1 - state_.best.score,
          .overrides = best_overrides(state_),
          .seed = best_seed(state_),
          .metrics = state_.best_metrics,
          .full_size_metrics =
              state_.full_size ? std::optional<MaskMetrics>(state_.full_size->metrics) : std::nullopt,
          .portrait = state_.portrait,
          .resemblances = state_.resemblances,
          .evaluations = state_.evaluations,
          .branch_steps = state_.branches.steps,
          .seconds = state_.seconds,
          .stopped_by = *state_.stopped_by,
          .best_start = best_start->name,
          .dimension = dimension_,
          .failures = state_.failures};
}

FitResult FitRun::run(const std::optional<SpeciesSpace>& species) {
  search_from_starts(species);
  if (will_refine()) refine();
  return finish();
}

void FitRun::replay(const std::optional<SpeciesSpace>& species) {
  search_from_starts(species);
  const std::size_t replayed = static_cast<std::size_t>(scorer_.evaluations());
  if (replayed < log_.logged().size())
    throw_input_error(
        "evaluations.bin: got {} evaluations, of which the search makes {}, expected the same program, "
        "libraries and presets as in the run that began",
        log_.logged().size(), replayed);
}

}  // namespace espalier
