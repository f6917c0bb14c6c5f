// The stages of a run that are about branches: traced, refined, finished.
#include <espalier/fitting/branches/branch_refinement.h>
#include <espalier/fitting/branches/branch_tracing.h>
#include <espalier/fitting/picture/picture_reading.h>
#include <espalier/fitting/run/finish.h>
#include <espalier/fitting/run/fit_run.h>

namespace espalier {

bool FitRun::will_refine() const {
  return record_.stages.refine() && record_.budget.branch_rounds != 0 && record_.fit_seeds == 1 &&
         task_.model->has_branch_paths();
}

bool FitRun::is_traced() const {
  return record_.stages.tracing && state_.kind == KindChoice::leafless &&
         can_trace(*task_.model, given_overrides_);
}

/// The fringe of a palm's fronds and the rim of its trunk are thinner than a pixel of twice the search's
/// size.
bool FitRun::finishes_at_full_size() const { return is_traced() || state_.kind == KindChoice::palm; }

/// Branch by branch, from the best of the search; what ended the search does not end this.
void FitRun::refine() {
  if (state_.stopped_by == FitStop::interrupted || state_.stopped_by == FitStop::target_fitness) return;
  state_.stopped_by.reset();
  state_.best = scorer_.best();
  if (auto reached = reached_rounds(record_, task_, directory_, options_)) {
    restore(task_.model->table(), *reached);
    go_on_from(*reached);
  } else {
    const std::vector<Solution> starts = refinement_starts();
    stage_ = starts.size() > 1 ? FitStage::tracing : FitStage::branches;
    state_.branches = begin_branch_rounds(task_, starts, scorer_.evaluations());
    state_.branches.search_limit = record_.budget.evaluations;
    note_round();
  }
  refine_by_rounds();
}

void FitRun::refine_by_rounds() {
  if (finishing()) finer_task_ = with_finer_views(record_, task_, finishes_at_full_size(), sized_tasks_);
  while (!stop_requested()) {
    if (state_.branches.rounds == record_.budget.branch_rounds) {
      state_.stopped_by = FitStop::rounds;
      return;
    }
    const double before_finish = is_traced() ? 0 : plan_.shares.before_finish;
    if (!finishing() && finish_is_due(record_, before_finish, state_.branches, seconds())) begin_finish();
    stage_ = finishing() ? FitStage::finish : FitStage::branches;
    refine_round(finishing() ? *finer_task_ : task_, record_.seed, threads_, state_.branches);
    note_round();
  }
}

/// From here on copies are scored at both sizes.
void FitRun::begin_finish() {
  finer_task_ = with_finer_views(record_, task_, finishes_at_full_size(), sized_tasks_);
  state_.branches.finish_from = state_.branches.rounds;
  rescore(*finer_task_, state_.branches);
  stage_ = FitStage::finish;
  note_round();
}

/// The best of the search; beside it, where the picture shows its branches, the tree traced along them.
std::vector<Solution> FitRun::refinement_starts() {
  const Solution searched{scorer_.best().values, task_.plant_seeds.front(), given_overrides_,
                          scorer_.best().score};
  std::vector<Solution> starts{searched};
  if (is_traced())
    starts.push_back(trace_branches(sized_tasks_.at(kFullSizePx), {.key = root_key(record_.seed)}, searched));
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
  const bool is_plain = !finishing() && task_.freedom.price == 0;
  const double score = is_plain ? best.score : score_of(task_, best);
  state_.branches.history.push_back(
      {stage_, state_.branches.steps, seconds(), score, best.score, mean_metrics(task_, masks)});
  add_to_trace(state_.branches.history.back());
  refresh_directory_if_old();
  report_progress();
}

void FitRun::add_to_trace(const RoundRow& row) {
  const bool improved = row.score < state_.best.score;
  state_.best.score = row.score;
  state_.best.values = state_.branches.best().values;
  state_.best_metrics = row.metrics;
  state_.trace.add_round(scorer_.evaluations(), row.steps, row.seconds, improved, row.score, row.metrics,
                         row.stage);
}

}  // namespace espalier
