#include <algorithm>
#include <cmath>

#include <espalier/fitting/run/finish.h>
#include <espalier/fitting/run/full_size.h>

namespace espalier {

FitTask with_finer_views(const FitRecord& record, const FitTask& task, bool at_full_size, SizedTasks& sized) {
  FitTask finer = task;
  const int size_px = at_full_size ? kFullSizePx : std::min(2 * record.target.size_px, kFullSizePx);
  if (size_px <= record.target.size_px) return finer;
  if (at_full_size) finer.views.clear();
  for (const TargetView& view : sized.at(size_px).views) finer.views.push_back(view);
  return finer;
}

bool finish_is_due(const FitRecord& record, double share_before, const BranchRounds& state, double seconds) {
  const FitBudget& budget = record.budget;
  if (!record.stages.finish) return false;
  if (!record.stages.branches) return true;
  if (budget.finish_from != kLastShare) return state.rounds >= budget.finish_from;
  const auto rounds = static_cast<double>(state.rounds);
  if (budget.branch_rounds > 0 &&
      rounds >= std::ceil(share_before * static_cast<double>(budget.branch_rounds)))
    return true;
  const double began = state.history.front().seconds;
  return budget.seconds > 0 && seconds >= began + share_before * (budget.seconds - began);
}

}  // namespace espalier
