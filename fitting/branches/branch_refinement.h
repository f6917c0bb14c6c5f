// Stage 5 of a fit: branch by branch. Each branch of one order gets offsets on what the model gives it
// (length, place along the parent, angles, curvature, radius, and other random numbers) by a (1+1) evolution
// strategy. A step grows and draws that branch alone and joins it to the stored silhouette of all the rest,
// so it costs a small part of an evaluation. Beyer & Schwefel 2002 (Evolution strategies), §2: success rule
// of Rechenberg. Locked branches stay as they are, with all on them; what bears one may turn and bend with
// it.
#pragma once
#include <espalier/fitting/branches/solution.h>
#include <espalier/fitting/task/fit_task.h>

namespace espalier {

struct RefinementSettings {
  int order = 1;       ///< of the branches: 0 are trunks, 1 what stands on them or splits off them
  long steps = 2'000;  ///< candidates to try, over all branches
  int steps_per_visit = 24;
  RandomKey key;  ///< of the search's draws
};

/// Refines `solution` in place; its score becomes that of the result and is never worse than before. Returns
/// the number of steps made: none where the tree has no such branch.
long refine_branches(const FitTask& task, const RefinementSettings& settings, Solution& solution);

/// The dissimilarity of the whole tree, the mean over all views.
double score_of(const FitTask& task, const Solution& solution);

/// The same and the price of all numbers that its branches have of their own: what is refined by.
double priced_score_of(const FitTask& task, const Solution& solution);

}  // namespace espalier
