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
  double moves_points = 0.5;   ///< chance that it moves points of an axis, where the branch has one
  double point_range = 0.25;   ///< of a point, over the branch's length, at a step size of 1
  double forgets = 0.15;  ///< chance that it gives one number back to the model, where numbers have a price
};
inline constexpr BranchStepPolicy kBranchStep;

/// Of how far from the viewer traced branches lie (branch_depths.h), where a depth is over the length in the
/// picture.
struct DepthPolicy {
  double outward = 0.7;     ///< most of a branch on a branch
  double steepest = 1.2;    ///< most of a branch on the trunk, in a crown that is deep enough with it
  double most_steep = 3;    ///< the same in any crown
  double over_width = 0.9;  ///< depth over width of a crown that is deep enough
};
inline constexpr DepthPolicy kDepth;

/// Of laying a branch on a line (branch_laying.h).
struct LayingPolicy {
  std::size_t points = 48;      ///< of the line, that the axis is fitted to
  int turns = 8;                ///< sides of the parent that the branch may stand on
  int moves = 3;                ///< steps along the parent to where the line begins
  double tolerance_px = 0.5;    ///< root mean square, of an axis that needs no more points
  double to_bends = 2;          ///< weight of bends, over that of length, in where these points are
  double least_bend = 0.5;      ///< radians: lines that bend less are as those that do not
  double least_px_a_point = 3;  ///< of the line's length: shorter lines have axes of fewer points
};
inline constexpr LayingPolicy kLaying;

}  // namespace espalier
