#include <algorithm>
#include <cmath>

#include <espalier/fitting/run/finish.h>
#include <espalier/fitting/run/full_size.h>
#include <espalier/fitting/task/record_task.h>

namespace espalier {

namespace {

constexpr double kShareBefore = 0.6;  ///< of the refinement; chosen in experiments/closeness.md

}  // namespace

FitTask with_finer_views(const FitRecord& record, const FitTask& task) {
  FitTask finer = task;
  const int size_px = std::min(2 * record.target.size_px, kFullSize_px);
  if (size_px <= record.target.size_px) return finer;
  for (TargetView& view : make_task_at(record, size_px, task.model).views)
    finer.views.push_back(std::move(view));
  return finer;
}

bool finish_is_due(const FitRecord& record, const BranchRounds& state, double seconds) {
  const FitBudget& budget = record.budget;
  if (!record.stages.finish) return false;
  if (!record.stages.branches) return true;
  if (budget.finish_from != kLastShare) return state.rounds >= budget.finish_from;
  const auto rounds = static_cast<double>(state.rounds);
  if (budget.branch_rounds > 0 &&
      rounds >= std::ceil(kShareBefore * static_cast<double>(budget.branch_rounds)))
    return true;
  const double began = state.history.front().seconds;
  return budget.seconds > 0 && seconds >= began + kShareBefore * (budget.seconds - began);
}

}  // namespace espalier
