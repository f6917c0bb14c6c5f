// Constants of how branches are searched, with where they are from. They were set when the stages were built
// and never varied one by one, where no page is named: a study of them is open. Changing any changes all
// fits.
#pragma once
#include <cstddef>

namespace espalier {

/// Of a step of the refinement (branch_refinement.h): what it does to one branch.
struct BranchStepPolicy {
  double removes = 0.04;       ///< chance that it removes the branch
  double returns = 0.3;        ///< chance that it brings back a branch that is removed
  double return_spread = 0.5;  ///< standard deviation of the offsets that a branch comes back with
  double reseeds = 0.08;       ///< chance that it draws the branch other random numbers
  double moves_all = 0.3;      ///< chance that it changes all offsets
  double moves_each = 0.4;     ///< chance of each offset, where not all are changed
  double forgets = 0.15;  ///< chance that it gives one number back to the model, where numbers have a price
};
inline constexpr BranchStepPolicy kBranchStep;

/// Of laying a branch on a line (branch_laying.h).
struct LayingPolicy {
  std::size_t points = 9;     ///< compared along a line
  double depth_weight = 0.1;  ///< of errors in depth, against those in the picture
  int first_turns = 12;       ///< directions tried around the parent before the strategy begins
  int steps = 700;            ///< of the evolution strategy
  double first_sigma = 0.2;
  double reseeds = 0.15;    ///< chance that a step draws the branch other random numbers
  double moves_each = 0.5;  ///< chance of each offset
};
inline constexpr LayingPolicy kLaying;

}  // namespace espalier
