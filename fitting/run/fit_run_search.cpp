// The stages of a run before branches: starts, the species space, parameters.
#include <algorithm>
#include <numeric>

#include <espalier/fitting/run/fit_run.h>
#include <espalier/fitting/search/fit_objective.h>
#include <espalier/fitting/task/record_task.h>

namespace espalier {

namespace {

constexpr std::size_t kStartBatch = 8;  ///< start points scored between two looks at the clock
constexpr std::size_t kMostStarts = 3;  ///< of the best, given to the optimiser

}  // namespace

/// Where refinement follows for as long as time lasts.
bool FitRun::search_time_is_over() const {
  return record_.budget.branch_rounds == kWhileTimeLasts && will_refine() && state_.branches.copies.empty() &&
         record_.stages.search && seconds() >= plan_.shares.search * record_.budget.seconds;
}

void FitRun::on_scored(const ScoredBatch& batch) {
  if (replay_.on_batch) return replay_.on_batch(stage_, batch);
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
  refresh_directory_if_old();
  report_progress();
}

void FitRun::warn_over_budget(const std::string& start, double factor) const {
  options_.on_warning(fmt::format(
      "start '{}': got {:.3g} times as many stems or leaves as a candidate may have, expected at most "
      "{:g} and {:g}: it was not grown",
      start, factor, record_.growth.max_stems, record_.growth.max_leaves));
}

void FitRun::search_from_starts(const std::optional<SpeciesSpace>& species) {
  std::vector<StartPoint> starts = plan_.starts;
  std::vector<double> scores = score_starts(starts);
  plant_scorer_.score_failures_as_worst();
  if (species) search_species(*species, starts, scores);
  if (record_.stages.search)
    search(starts, scores);
  else
    begin_from_best(starts, scores);
}

std::vector<double> FitRun::score_starts(const std::vector<StartPoint>& starts) {
  std::vector<ParameterValues> candidates;
  candidates.reserve(starts.size());
  for (const StartPoint& start : starts) candidates.push_back(start.values);
  std::vector<double> scores(candidates.size(), kNotEvaluated);
  for (std::size_t first = 0; first < scores.size(); first += kStartBatch) {
    if (first > 0 && stop_requested()) break;
    const std::size_t count = std::min(kStartBatch, scores.size() - first);
    scorer_.score(std::span(candidates).subspan(first, count), std::span(scores).subspan(first, count));
  }
  for (std::size_t i = 0; i < scores.size(); ++i) {
    if (scores[i] >= kNotEvaluated) continue;
    state_.starts.push_back({starts[i].name, 1 - scores[i]});
    if (scores[i] > 1 && scores[i] < kFailedCandidate)
      warn_over_budget(starts[i].name, over_budget_factor(scores[i]));
  }
  return scores;
}

MinimizeResult FitRun::minimize(const Objective& objective, long evaluations,
                                std::span<const double> points) {
  return optimizer_of(record_, options_)
      .minimize(objective, record_.optimizer_settings, {evaluations}, points, record_.seed, *this);
}

/// Searches the coordinates from those of the best start, with its leaves or without; what it finds joins the
/// starts.
void FitRun::search_species(const SpeciesSpace& species, std::vector<StartPoint>& starts,
                            std::vector<double>& scores) {
  if (stop_requested()) return;
  stage_ = FitStage::species_space;
  const Model& model = *task_.model;
  const auto best = static_cast<std::size_t>(std::min_element(scores.begin(), scores.end()) - scores.begin());
  const ParameterValues start = starts[best].values;
  const auto prepare = [&](ParameterValues& values) {
    prepare_start(model, record_.growth, target_height_m(record_), task_.plant_seeds.front(), values);
    if (!has_leaves(model.table(), start)) take_leaves(model.table(), values);
    keep_in_ranges(model.table(), plan_.choice, values);
    apply_fixed(model.table(), plan_.choice, values);
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
  const SearchSpace space = make_search_space(task_.model->table(), starts[order[0]].values, plan_.choice,
                                              target_height_m(record_) / kNominalHeightM);
  dimension_ = space.dimension();
  if (stop_requested()) return;
  std::vector<double> points;
  for (std::size_t i = 0; i < std::min(kMostStarts, order.size()); ++i) {
    const std::vector<double> point = space.encode(starts[order[i]].values);
    points.insert(points.end(), point.begin(), point.end());
  }
  stage_ = FitStage::search;
  state_.archive.emplace(space);
  minimize(FitObjective(space, scorer_), kUnlimited, points);
  if (!stop_requested()) state_.stopped_by = FitStop::converged;
}

/// Without a search.
void FitRun::begin_from_best(const std::vector<StartPoint>& starts, const std::vector<double>& scores) {
  const auto best = static_cast<std::size_t>(std::min_element(scores.begin(), scores.end()) - scores.begin());
  if (!starts[best].overrides.empty()) given_overrides_ = starts[best].overrides;
  if (!state_.stopped_by) state_.stopped_by = FitStop::stages;
}

}  // namespace espalier
