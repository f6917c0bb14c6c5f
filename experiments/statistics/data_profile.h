// Data profiles: the share of all (target, run, level) triples that an optimiser has reached within N true
// evaluations. Moré, Wild, "Benchmarking derivative-free optimization algorithms" (SIAM J. Optim. 20, 2009);
// the same curves are COCO's empirical runtime distributions: Hansen, Auger, Ros, Mersmann, Tušar, Brockhoff,
// "COCO: a platform for comparing continuous optimizers in a black-box setting" (Optim. Methods Softw. 36,
// 2021). Nobody knows the best possible fitness on a picture, so levels are relative to the best that any run
// reached.
#pragma once
#include <span>
#include <string>
#include <vector>

#include <espalier/experiments/statistics/curves.h>

namespace espalier {

struct ProfileRun {
  std::string optimizer, target;
  StepCurve curve;  ///< without rows where the run failed: it reaches no level
};

struct LevelSettings {
  long first_evaluations = 100;  ///< the easiest level is the median fitness of all runs here
  std::size_t levels = 20;       ///< at least 2
  double smallest_gap = 0.01;    ///< of the hardest level, as a share of the easiest one's; in (0, 1)
};

/// The levels of one target from the curves of all optimisers on it, from the easiest to the hardest:
///   level_i = best - τ_i·(best - base),  τ_i = smallest_gap^(i / (levels - 1)),  i = 0 … levels - 1
/// (Moré, Wild 2009, inequality 2.2, with evenly spaced log τ). `best` is the highest fitness of any curve,
/// `base` the median fitness after first_evaluations; a curve whose first row is later counts with that row.
/// Empty where no curve has rows.
std::vector<double> fitness_levels(std::span<const StepCurve> curves, const LevelSettings& settings = {});

struct ProfileRow {
  std::string optimizer;
  long evaluations = 0;
  double share = 0;  ///< in [0, 1], never falling with evaluations; levels never reached count as not reached
};

/// A row a point of the grid for each optimiser, in the order in which optimisers appear in `runs`. A target
/// on which every run failed has no levels and counts for nobody.
std::vector<ProfileRow> data_profiles(std::span<const ProfileRun> runs, std::span<const long> grid,
                                      const LevelSettings& settings = {});

}  // namespace espalier
