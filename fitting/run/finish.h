// Stage 6 of a fit: the last rounds of refinement look at the pictures at twice the size of the search as
// well. Twigs and gaps thinner than a pixel of the small masks meet pixel centres there by chance, and a
// refinement fits the chance too; where both sizes have to be right, what is right is the tree. Traced trees
// are refined in this stage alone, and palms end in it, both at full size.
#pragma once
#include <espalier/fitting/branches/branch_rounds.h>
#include <espalier/fitting/record/fit_record.h>
#include <espalier/fitting/task/fit_task.h>
#include <espalier/fitting/task/sized_tasks.h>

namespace espalier {

/// The task, which looks at its pictures at their own size and at twice that, but no larger than
/// kFullSizePx: the views of a larger search are left as they are. `at_full_size`: at masks of kFullSizePx
/// alone, as of a traced tree, whose branches lie within a pixel or two of the picture's there, and of a
/// palm. Throws InputError where the pictures can no longer be read.
FitTask with_finer_views(const FitRecord& record, const FitTask& task, bool at_full_size, SizedTasks& sized);

/// Whether the rounds that follow belong to the finish: from the record's round on, else after `share_before`
/// of the rounds or of the time that the refinement is given. `seconds` of the run so far.
bool finish_is_due(const FitRecord& record, double share_before, const BranchRounds& state, double seconds);

}  // namespace espalier
