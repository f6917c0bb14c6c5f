// A start for branch by branch refinement, where the picture shows the branches: trunk and branches are
// traced along the medial axes of the mask (image/reading/medial_axes.h), and each becomes one branch of a
// plain tree, with a drawn axis that is fitted to it (branch_laying.h). How far a branch comes out of the
// picture's plane no silhouette says: each gets a moderate angle towards the viewer or away from him, so that
// the tree is not flat.
#pragma once
#include <espalier/fitting/branches/solution.h>
#include <espalier/fitting/task/fit_task.h>

namespace espalier {

struct TracingSettings {
  double shortest = 0.012;  ///< axis that becomes a branch, as a share of the picture's tree
  RandomKey key;            ///< of the search's draws
};

/// Whether the model's table says by roles how long and how thick a trunk is (tree_scale, and trunk_ratio or
/// trunk_radius), and no branch is locked: a traced tree has no branch of the one before it.
bool can_trace(const Model& model, const Overrides& overrides);

/// The traced tree, with `start`'s leaves and bark, and its score. `start` itself where it cannot be traced,
/// or the mask has no axes. Only the first view is traced.
Solution trace_branches(const FitTask& task, const TracingSettings& settings, const Solution& start);

}  // namespace espalier
