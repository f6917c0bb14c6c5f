#include "fitting/fit.h"

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <numeric>

#include "core/error.h"
#include "fitting/certainty_files.h"
#include "fitting/fit_objective.h"
#include "fitting/picture_choice.h"
#include "fitting/plant_scorer.h"
#include "fitting/record_task.h"
#include "fitting/space_search.h"
#include "fitting/stages/branch_tracing.h"
#include "fitting/stages/finish.h"
#include "fitting/stages/picture_reading.h"
#include "fitting/start_points.h"
#include "models/models.h"

namespace espalier {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kStartBatch = 8;  ///< start points scored between two looks at the clock
constexpr std::size_t kMostStarts = 3;  ///< of the best, given to the optimiser
constexpr double kRefreshSeconds = 3;   ///< the directory is at most this old, unless writing it is slow
constexpr double kRefreshShare = 0.02;  ///< of the time, at most, is spent writing the directory
constexpr long kCertaintyShare = 10;    ///< one evaluation to so many of the search tells how sure it is

/// The optimiser never sees the limit (LoggedScorer keeps it), so that it does the same for every limit.
constexpr long kUnlimited = 1'000'000'000;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

FitTask task_of(FitRecord& record, const FitOptions& options) {
  FitTask task = make_task(record, options.model);
  task.make_renderer = options.make_renderer;
  hold_trunk(record, task);
  return task;
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
void check_optimizer(const FitRecord& record, const Objective& objective) {
  StopAtOnce stop;
  optimizer_by_name(record.optimizer)
      .minimize(objective, record.optimizer_settings, {kUnlimited}, {}, record.seed, stop);
}

/// The same for each of the searches the run will make.
void check_searches(const FitRecord& record, const SearchSpace& space,
                    const std::optional<SpeciesSpace>& species) {
  NoScorer no_scorer;
  check_optimizer(record, FitObjective(space, no_scorer));
  if (species) check_optimizer(record, SpaceObjective(*species, {}, {}, no_scorer));
}

/// The species space the run searches first, if it does.
std::optional<SpeciesSpace> space_of(const FitRecord& record, const Model& model) {
  const int components = parse_search_space(record.space);
  if (components == 0) return std::nullopt;
  return bundled_species_space(model, components);
}

/// The refinement that a run to be resumed had begun, unless its search is now to go further.
std::optional<BranchRounds> reached_rounds(const FitRecord& record, const fs::path& directory,
                                           const FitOptions& options) {
  std::optional<BranchRounds> reached = options.resume ? read_branch_rounds(directory) : std::nullopt;
  if (reached && reached->search_limit != record.budget.evaluations) reached.reset();
  return reached;
}

/// A search that refinement had followed ends where it ended then.
long evaluation_limit(const FitRecord& record, const fs::path& directory, const FitOptions& options) {
  const auto reached = reached_rounds(record, directory, options);
  return reached ? reached->search_evaluations : record.budget.evaluations;
}

/// One run: its state, its clock, and when it stops.
class FitRun : public Observer {
 public:
  FitRun(const FitRecord& record, const FitTask& task, const fs::path& directory, const FitOptions& options)
      : record_(record),
        threads_(options.threads > 0 ? options.threads : omp_get_num_procs()),
        task_(task),
        directory_(directory),
        options_(options),
        state_{.record = record, .task = task, .kind = kind_of(record, task)},
        choice_(choice_for(record, task)),
        log_(directory / "evaluations.bin"),
        plant_scorer_(task, threads_),
        scorer_(
            plant_scorer_, log_, evaluation_limit(record, directory, options), [this] { return seconds(); },
            [this](const ScoredBatch& batch) { on_scored(batch); }),
        renderer_(task.make_renderer()),
        given_overrides_(task.overrides) {}

  FitResult run(std::vector<StartPoint> starts, const std::optional<SpeciesSpace>& species);
  bool stop_requested() override;

 private:
  double seconds() const { return seconds_before_ + seconds_since(live_since_); }
  void on_scored(const ScoredBatch& batch);
  void refresh_directory();
  std::vector<double> score_starts(const std::vector<StartPoint>& starts);
  void search_species(const SpeciesSpace& species, std::vector<StartPoint>& starts,
                      std::vector<double>& scores);
  MinimizeResult minimize(const Objective& objective, long evaluations, std::span<const double> points);
  void search(const std::vector<StartPoint>& starts, const std::vector<double>& scores);
  void begin_from_best(const std::vector<StartPoint>& starts, const std::vector<double>& scores);
  bool will_refine() const {
    return record_.stages.refine() && record_.budget.branch_rounds != 0 && record_.fit_seeds == 1 &&
           task_.model->has_branch_paths();
  }
  bool search_time_is_over() const;
  void measure_how_sure();
  void refine();
  std::vector<Solution> refinement_starts();
  void go_on_from(const BranchRounds& reached);
  void refine_by_rounds();
  void begin_finish();
  bool finishing() const { return state_.branches.finish_from >= 0; }
  void note_round();
  void add_to_trace(const RoundRow& row);
  MaskMetrics untrained_metrics();
  void report_progress() const;
  FitResult finish();

  const FitRecord& record_;
  int threads_;
  const FitTask& task_;
  fs::path directory_;
  const FitOptions& options_;
  RunState state_;
  SearchChoice choice_;
  EvaluationLog log_;
  PlantScorer plant_scorer_;
  LoggedScorer scorer_;
  std::unique_ptr<SilhouetteRenderer> renderer_;
  std::optional<FitTask> finer_task_;  ///< once the finish begins
  Overrides given_overrides_;          ///< of the tree that the refinement starts from
  std::size_t dimension_ = 0;
  std::string stage_ = "starts";
  double seconds_before_ = 0;  ///< of the run up to live_since_
  Clock::time_point live_since_ = Clock::now();
  double refreshed_at_ = 0, refresh_cost_ = 0;
};

bool FitRun::stop_requested() {
  if (state_.stopped_by) return true;
  const FitBudget& budget = record_.budget;
  const bool refining = !state_.branches.lanes.empty();
  const double best_score = refining ? state_.best.score : scorer_.best().score;
  if (!refining && scorer_.limit_reached())
    state_.stopped_by = "evaluations";
  else if (budget.target_fitness > 0 && 1 - best_score >= budget.target_fitness)
    state_.stopped_by = "target_fitness";
  else if (scorer_.replaying())
    return false;
  else if (options_.stop_requested())
    state_.stopped_by = "interrupted";
  else if (budget.seconds > 0 && seconds() >= budget.seconds)
    state_.stopped_by = "time";
  return state_.stopped_by.has_value() || search_time_is_over();
}

/// Where refinement follows for as long as time lasts.
bool FitRun::search_time_is_over() const {
  return record_.budget.branch_rounds == kWhileTimeLasts && will_refine() && state_.branches.lanes.empty() &&
         record_.stages.search && seconds() >= search_share(state_.kind) * record_.budget.seconds;
}

void FitRun::on_scored(const ScoredBatch& batch) {
  if (batch.replayed) {
    seconds_before_ = batch.seconds;
    live_since_ = Clock::now();
  }
  if (batch.improved)
    state_.best_metrics = mean_metrics(task_, draw_candidate(task_, scorer_.best().values, *renderer_));
  state_.trace.add(batch, scorer_.best().score, state_.best_metrics, stage_);
  for (std::size_t i = 0; state_.archive && i < batch.scores.size(); ++i)
    state_.archive->offer(batch.candidates[i], batch.scores[i]);
  if (batch.replayed) return;
  if (seconds() - refreshed_at_ > std::max(kRefreshSeconds, refresh_cost_ / kRefreshShare))
    refresh_directory();
  report_progress();
}

void FitRun::refresh_directory() {
  const double began = seconds();
  if (state_.branches.lanes.empty()) state_.best = scorer_.best();
  state_.evaluations = static_cast<long>(scorer_.evaluations());
  state_.seconds = began;
  state_.failures = plant_scorer_.failures();
  write_run_directory(directory_, state_);
  refreshed_at_ = seconds();
  refresh_cost_ = refreshed_at_ - began;
}

void FitRun::report_progress() const {
  const FitBudget& budget = record_.budget;
  const double score = state_.branches.lanes.empty() ? scorer_.best().score : state_.best.score;
  FitProgress progress{scorer_.evaluations(), state_.branches.steps, seconds(), 1 - score, {}};
  if (budget.seconds > 0) progress.seconds_left = std::max(0.0, budget.seconds - progress.seconds);
  if (budget.evaluations > 0 && budget.branch_rounds == 0) {
    const auto left = static_cast<double>(budget.evaluations - progress.evaluations);
    const double by_count = left * progress.seconds / static_cast<double>(progress.evaluations);
    progress.seconds_left = std::min(by_count, progress.seconds_left.value_or(by_count));
  }
  options_.on_progress(progress);
}

std::vector<double> FitRun::score_starts(const std::vector<StartPoint>& starts) {
  std::vector<ParameterValues> candidates;
  for (const StartPoint& start : starts) candidates.push_back(start.values);
  std::vector<double> scores(candidates.size(), kNotEvaluated);
  for (std::size_t first = 0; first < scores.size(); first += kStartBatch) {
    if (first > 0 && stop_requested()) break;
    const std::size_t count = std::min(kStartBatch, scores.size() - first);
    scorer_.score(std::span(candidates).subspan(first, count), std::span(scores).subspan(first, count));
  }
  for (std::size_t i = 0; i < scores.size(); ++i)
    if (scores[i] < kNotEvaluated) state_.starts.push_back({starts[i].name, 1 - scores[i]});
  return scores;
}

MinimizeResult FitRun::minimize(const Objective& objective, long evaluations,
                                std::span<const double> points) {
  return optimizer_by_name(record_.optimizer)
      .minimize(objective, record_.optimizer_settings, {evaluations}, points, record_.seed, *this);
}

/// Searches the coordinates from those of the best start, with its leaves or without; what it finds joins the
/// starts.
void FitRun::search_species(const SpeciesSpace& species, std::vector<StartPoint>& starts,
                            std::vector<double>& scores) {
  if (stop_requested()) return;
  stage_ = "species_space";
  const Model& model = *task_.model;
  const auto best = static_cast<std::size_t>(std::min_element(scores.begin(), scores.end()) - scores.begin());
  const ParameterValues start = starts[best].values;
  const auto prepare = [&](ParameterValues& values) {
    prepare_start(model, record_.growth, target_height_m(record_), task_.plant_seeds.front(), values);
    if (!has_leaves(model.table(), start)) take_leaves(model.table(), values);
    keep_in_ranges(model.table(), choice_, values);
    apply_fixed(model.table(), choice_, values);
  };
  const SpaceObjective objective(species, start, prepare, scorer_);
  const std::vector<double> begin = objective.box().unit(coordinates_of(species, start));
  const MinimizeResult found = minimize(objective, record_.space_evaluations, begin);
  if (found.best_point.empty()) return;
  starts.push_back({"species space", objective.candidate(found.best_point)});
  scores.push_back(found.best_value);
  state_.starts.push_back({"species space", 1 - found.best_value});
}

void FitRun::search(const std::vector<StartPoint>& starts, const std::vector<double>& scores) {
  std::vector<std::size_t> order(starts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return scores[a] < scores[b]; });
  const SearchSpace space = make_search_space(task_.model->table(), starts[order[0]].values, choice_,
                                              target_height_m(record_) / kNominalHeightM);
  dimension_ = space.dimension();
  if (stop_requested()) return;
  std::vector<double> points;
  for (std::size_t i = 0; i < std::min(kMostStarts, order.size()); ++i) {
    const std::vector<double> point = space.encode(starts[order[i]].values);
    points.insert(points.end(), point.begin(), point.end());
  }
  stage_ = "search";
  state_.archive.emplace(space);
  minimize(FitObjective(space, scorer_), kUnlimited, points);
  if (!stop_requested()) state_.stopped_by = "converged";
}

/// Without a search.
void FitRun::begin_from_best(const std::vector<StartPoint>& starts, const std::vector<double>& scores) {
  const auto best = static_cast<std::size_t>(std::min_element(scores.begin(), scores.end()) - scores.begin());
  if (!starts[best].overrides.empty()) given_overrides_ = starts[best].overrides;
  if (!state_.stopped_by) state_.stopped_by = "stages";
}

/// From the search alone, so that it comes out the same when the run is resumed.
void FitRun::measure_how_sure() {
  if (!state_.archive || state_.stopped_by == "interrupted") return;
  state_.certainty = measure_certainty(*state_.archive, plant_scorer_,
                                       scorer_.evaluations() / kCertaintyShare, record_.seed);
}

/// Branch by branch, from the best of the search; what ended the search does not end this.
void FitRun::refine() {
  if (state_.stopped_by == "interrupted" || state_.stopped_by == "target_fitness") return;
  state_.stopped_by.reset();
  state_.best = scorer_.best();
  const auto reached = reached_rounds(record_, directory_, options_);
  if (reached)
    go_on_from(*reached);
  else {
    const std::vector<Solution> starts = refinement_starts();
    stage_ = starts.size() > 1 ? "tracing" : "branches";
    state_.branches = begin_branch_rounds(task_, starts, scorer_.evaluations());
    state_.branches.search_limit = record_.budget.evaluations;
    note_round();
  }
  refine_by_rounds();
}

void FitRun::refine_by_rounds() {
  if (finishing()) finer_task_ = with_finer_views(record_, task_);
  while (!stop_requested()) {
    if (state_.branches.rounds == record_.budget.branch_rounds) {
      state_.stopped_by = "rounds";
      return;
    }
    if (!finishing() && finish_is_due(record_, state_.branches, seconds())) begin_finish();
    stage_ = finishing() ? "finish" : "branches";
    refine_round(finishing() ? *finer_task_ : task_, record_.seed, threads_, state_.branches);
    note_round();
  }
}

/// From here on scores are those at both sizes.
void FitRun::begin_finish() {
  finer_task_ = with_finer_views(record_, task_);
  state_.branches.finish_from = state_.branches.rounds;
  rescore(*finer_task_, state_.branches);
  stage_ = "finish";
  note_round();
}

/// The best of the search; beside it, where the picture shows its branches, the tree traced along them.
std::vector<Solution> FitRun::refinement_starts() {
  const Solution searched{scorer_.best().values, task_.plant_seeds.front(), given_overrides_,
                          scorer_.best().score};
  std::vector<Solution> starts{searched};
  if (record_.stages.tracing && state_.kind == kind_name(TreeKind::leafless))
    starts.push_back(trace_branches(make_task_at(record_, kFullSize_px, task_.model),
                                    {.key = root_key(record_.seed)}, searched));
  return starts;
}

/// The state that a run which was broken off had reached, and its rows of the trace.
void FitRun::go_on_from(const BranchRounds& reached) {
  state_.branches = reached;
  for (const RoundRow& row : reached.history) add_to_trace(row);
  if (reached.history.empty()) return;
  seconds_before_ = reached.history.back().seconds;
  live_since_ = Clock::now();
}

void FitRun::note_round() {
  const Solution& best = state_.branches.best();
  const std::vector<Mask> masks = draw_candidate(task_, best.values, *renderer_, best.overrides);
  state_.branches.history.push_back(
      {stage_, state_.branches.steps, seconds(), best.score, mean_metrics(task_, masks)});
  add_to_trace(state_.branches.history.back());
  if (seconds() - refreshed_at_ > std::max(kRefreshSeconds, refresh_cost_ / kRefreshShare))
    refresh_directory();
  report_progress();
}

void FitRun::add_to_trace(const RoundRow& row) {
  const bool improved = row.score < state_.best.score;
  state_.best.score = row.score;
  state_.best.values = state_.branches.best().values;
  state_.best_metrics = row.metrics;
  state_.trace.add_round(scorer_.evaluations() + row.steps, row.seconds, improved, row.score, row.metrics,
                         row.stage);
}

/// Of the same parameters and overrides, grown as if there were no picture to grow into.
MaskMetrics FitRun::untrained_metrics() {
  FitTask free = task_;
  free.growth.prune_to = nullptr;
  free.growth.train = false;
  return mean_metrics(free, draw_candidate(free, state_.best.values, *renderer_, best_overrides(state_)));
}

FitResult FitRun::finish() {
  if (state_.branches.lanes.empty()) state_.best = scorer_.best();
  if (task_.growth.train) state_.metrics_untrained = untrained_metrics();
  if (!state_.branches.lanes.empty())
    state_.full_size = look_at_full_size(record_, task_, state_.branches.best());
  refresh_directory();
  const auto best_start =
      std::max_element(state_.starts.begin(), state_.starts.end(),
                       [](const auto& a, const auto& b) { return a.fitness < b.fitness; });
  return {.values = state_.best.values,
          .fitness = 1 - state_.best.score,
          .overrides = best_overrides(state_),
          .metrics = state_.best_metrics,
          .full_size_metrics =
              state_.full_size ? std::optional<MaskMetrics>(state_.full_size->metrics) : std::nullopt,
          .evaluations = state_.evaluations,
          .branch_steps = state_.branches.steps,
          .seconds = state_.seconds,
          .stopped_by = *state_.stopped_by,
          .best_start = best_start->name,
          .dimension = dimension_,
          .failures = state_.failures,
          .certainty = state_.archive ? certainty_in_words(state_.certainty, *state_.archive) : ""};
}

FitResult FitRun::run(std::vector<StartPoint> starts, const std::optional<SpeciesSpace>& species) {
  std::vector<double> scores = score_starts(starts);
  plant_scorer_.forgive_failures();
  if (species) search_species(*species, starts, scores);
  if (record_.stages.search)
    search(starts, scores);
  else
    begin_from_best(starts, scores);
  measure_how_sure();
  if (will_refine()) refine();
  return finish();
}

}  // namespace

FitResult fit(const FitRecord& given, const fs::path& directory, const FitOptions& options) {
  options.resume ? check_run_directory(directory) : check_new_directory(directory);
  check_record(given);
  FitRecord record = given;
  const FitTask task = task_of(record, options);
  const ParameterTable& table = task.model->table();
  const std::optional<SpeciesSpace> species = space_of(record, *task.model);
  check_searches(record, make_search_space(table, table.defaults(), record.search), species);
  const std::vector<StartPoint> starts = starts_for(record, task);
  begin_run_directory(directory, {.record = record, .task = task});
  for (const std::string& warning : task.warnings) options.on_warning(warning);
  return FitRun(record, task, directory, options).run(starts, species);
}

}  // namespace espalier
