#include <algorithm>

#include <espalier/core/error.h>
#include <espalier/fitting/run/full_size.h>

namespace espalier {

std::optional<FullSize> look_at_full_size(const FitRecord& record, const FitTask& task, SizedTasks& sized,
                                          const Solution& solution) try {
  FitTask full = sized.at(std::max(kFullSizePx, record.target.size_px));
  full.growth = task.growth;
  std::vector<Mask> best = draw_candidate(full, solution.values, *full.make_renderer(), solution.overrides);
  FullSize seen{mean_metrics(full, best), std::move(best), {}};
  for (const TargetView& view : full.views) seen.targets.push_back(view.target.mask());
  return seen;
} catch (const InputError&) {
  return std::nullopt;
}

}  // namespace espalier
