#include <algorithm>

#include <espalier/core/error.h>
#include <espalier/fitting/run/full_size.h>
#include <espalier/fitting/task/record_task.h>

namespace espalier {

std::optional<FullSize> look_at_full_size(const FitRecord& record, const FitTask& task,
                                          const Solution& solution) try {
  FitTask full = make_task_at(record, std::max(kFullSize_px, record.target.size_px), task.model);
  full.growth = task.growth;
  std::vector<Mask> best = draw_candidate(full, solution.values, *full.make_renderer(), solution.overrides);
  FullSize seen{mean_metrics(full, best), std::move(best), {}};
  for (const TargetView& view : full.views) seen.targets.push_back(view.target.mask());
  return seen;
} catch (const InputError&) {
  return std::nullopt;
}

}  // namespace espalier
