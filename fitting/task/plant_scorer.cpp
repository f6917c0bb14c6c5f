#include <omp.h>

#include <algorithm>
#include <cmath>
#include <exception>

#include <espalier/core/error.h>
#include <espalier/fitting/task/plant_depth.h>
#include <espalier/fitting/task/plant_scorer.h>
#include <espalier/fitting/task/wood_share.h>

namespace espalier {

namespace {

/// How many times the expected size exceeds the budget; at most 1 where it fits.
double estimated_excess(const FitTask& task, const ParameterValues& values) {
  const GrowthEstimate estimate = task.model->estimate(values);
  return std::max(estimate.stems / task.growth.budget.max_stems,
                  estimate.leaves / task.growth.budget.max_leaves);
}

/// What no silhouette shows: a crown of wood behind or before its leaves, and a depth that species do not
/// have.
double price_of_plant(const FitTask& task, const Plant& plant, double leaf_area) {
  double price = 0;
  if (expects_leaves(task))
    price += task.bare_wood_price * wood_excess(wood_share(branch_area_m2(plant), leaf_area));
  if (task.depth_price > 0)
    price += task.depth_price * depth_excess(depth_over_width(plant, task.views.front().camera));
  return price;
}

}  // namespace

double over_budget_penalty(double factor) { return 1 + std::log10(std::clamp(factor, 1.0, 1e300)); }

double over_budget_factor(double score) { return std::pow(10, score - 1); }

PlantScorer::PlantScorer(const FitTask& task, int threads)
    : task_(task), workers_(static_cast<std::size_t>(std::max(threads, 1))) {}

void PlantScorer::prepare(Worker& worker) const {
  worker.renderer = task_.make_renderer();
  worker.masks.resize(task_.views.size());
  if (expects_leaves(task_)) worker.leaves.resize(task_.views.size());
  for (std::size_t i = 0; i < task_.views.size(); ++i)
    worker.drawn_views.push_back(
        {&task_.views[i].camera, &worker.masks[i], worker.leaves.empty() ? nullptr : &worker.leaves[i]});
}

double PlantScorer::score_one(const ParameterValues& values, Seed seed, Worker& worker) const {
  const double excess = estimated_excess(task_, values);
  if (!(excess <= 1)) return over_budget_penalty(std::isnan(excess) ? 1e300 : excess);
  if (!worker.renderer) prepare(worker);
  worker.plant.clear();
  double leaf_area = 0;
  const GrowthResult growth =
      grow_and_draw(*task_.model, values, seed, task_.growth, *worker.renderer, worker.drawn_views,
                    worker.plant, expects_leaves(task_) ? &leaf_area : nullptr);
  if (!growth.grown) return over_budget_penalty(growth.over_budget_factor);
  return std::min(1.0, score_of_masks(task_, worker.masks, worker.leaves) +
                           price_of_plant(task_, worker.plant, leaf_area));
}

/// True where a seed of the candidate failed. Throws what is not to be forgiven.
bool PlantScorer::note_failure(std::span<const std::exception_ptr> errors) {
  const auto failed = std::find_if(errors.begin(), errors.end(),
                                   [](const std::exception_ptr& error) { return error != nullptr; });
  if (failed == errors.end()) return false;
  if (!scores_failures_) std::rethrow_exception(*failed);
  try {
    std::rethrow_exception(*failed);
  } catch (const InputError& error) {
    if (failures_.count++ == 0) failures_.first = error.what();
  }
  return true;
}

void PlantScorer::score(std::span<const ParameterValues> candidates, std::span<double> scores) {
  ESPALIER_CHECK_EQ(scores.size(), candidates.size());
  const std::size_t seeds = task_.plant_seeds.size();
  const auto task_count = static_cast<long>(candidates.size() * seeds);
  scores_by_seed_.assign(candidates.size() * seeds, 0);
  std::vector<std::exception_ptr> errors(scores_by_seed_.size());
#pragma omp parallel for schedule(dynamic, 1) num_threads(static_cast <int>(workers_.size()))
  for (long i = 0; i < task_count; ++i) {
    const auto slot = static_cast<std::size_t>(i);
    try {
      scores_by_seed_[slot] = score_one(candidates[slot / seeds], task_.plant_seeds[slot % seeds],
                                        workers_[static_cast<std::size_t>(omp_get_thread_num())]);
    } catch (...) {
      errors[slot] = std::current_exception();
    }
  }
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (note_failure(std::span(errors).subspan(i * seeds, seeds))) {
      scores[i] = kFailedCandidate;
      continue;
    }
    double sum = 0;
    for (std::size_t s = 0; s < seeds; ++s) sum += scores_by_seed_[i * seeds + s];
    scores[i] = sum / static_cast<double>(seeds);
  }
}

}  // namespace espalier
