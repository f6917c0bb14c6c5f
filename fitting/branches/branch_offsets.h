// What a search changes of one branch: seven offsets from what the model gives it, the points of its axis
// where it has one, other random numbers, or its removal. Written to, and read from, the overrides of its
// path, private to it.
#pragma once
#include <algorithm>
#include <array>
#include <optional>

#include <espalier/fitting/branches/solution.h>

namespace espalier {

/// One coordinate of a branch, up to 1; 0 leaves it as the model grows it.
struct BranchDimension {
  Quantity quantity;
  Relation relation;
  double range;        ///< of the offset at coordinate 1; of a factor: its logarithm
  double lowest = -1;  ///< coordinate
};

/// How far a branch may go from what the model gives it: much thinner, but not much thicker.
inline constexpr std::array<BranchDimension, 7> kBranchDimensions{{
    {Quantity::length, Relation::factor, 1.1},
    {Quantity::down_angle, Relation::offset, 70},
    {Quantity::rotation, Relation::offset, 180},
    {Quantity::curvature, Relation::offset, 120},
    {Quantity::curvature_back, Relation::offset, 90},
    {Quantity::position, Relation::offset, 0.3},
    {Quantity::radius, Relation::factor, 0.4, -4},
}};

/// The coordinate moved into its range, or into that share of it.
inline double clamped(std::size_t dimension, double x, double share = 1) {
  return std::clamp(x, share * kBranchDimensions[dimension].lowest, share);
}

struct BranchOffsets {
  BranchPath path;
  std::array<double, kBranchDimensions.size()> at{};  ///< coordinates of kBranchDimensions
  std::uint64_t seed = 0;                             ///< of other random numbers; 0: its own
  bool removed = false;
  std::optional<DrawnAxis> axis;  ///< it follows
};

/// Whether the offset changes nothing of a branch: a world's axis stands as it is drawn.
inline bool is_idle(std::size_t dimension, const BranchOffsets& branch) {
  return branch.axis && branch.axis->frame == AxisFrame::world &&
         kBranchDimensions[dimension].quantity == Quantity::down_angle;
}

BranchOffsets read_offsets(const BranchPath& path, const Overrides& overrides);

/// Leaves what the node says of other quantities as it is.
void write_offsets(const BranchOffsets& branch, Overrides& overrides);

/// What write_offsets writes of the branch: offsets that are not 0, a seed, its removal, its axis.
std::size_t count_numbers(const BranchOffsets& branch);

/// The same of all branches of a tree.
std::size_t count_numbers(const Overrides& overrides);

/// Whether the node takes its branch away.
bool removes(const OverrideNode& node);

/// The solution as far as it concerns the branch: its own node, those above it and those below.
Solution branch_alone(const BranchPath& path, const Solution& solution);

}  // namespace espalier
