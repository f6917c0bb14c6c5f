// The last look at a fit: its tree beside the target in masks of 512 pixels. A search looks at small ones,
// where twigs thinner than a pixel meet pixel centres by chance; these say how it does where they are seen.
#pragma once
#include <optional>
#include <vector>

#include <espalier/fitting/branches/solution.h>
#include <espalier/fitting/record/fit_record.h>
#include <espalier/fitting/task/fit_task.h>
#include <espalier/fitting/task/sized_tasks.h>

namespace espalier {

/// Side of the masks, unless the search looked at larger ones.
inline constexpr int kFullSizePx = 512;

struct FullSize {
  MaskMetrics metrics;
  std::vector<Mask> best, targets;  ///< of all views
};

/// Grows the tree as the task's searches did, trained into the same outlines. Nothing where the pictures can
/// no longer be read.
std::optional<FullSize> look_at_full_size(const FitRecord& record, const FitTask& task, SizedTasks& sized,
                                          const Solution& solution);

}  // namespace espalier
