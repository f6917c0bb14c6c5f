// The crown of a single branch, a foliage pad: how long the stems on it are. An envelope whose base is the
// base of the branch and whose top is its tip, as large as the branch is long (docs/crowns.md). It is of that
// branch alone: no branch inherits it. Source: the silhouettes of branches of Boudon et al. 2003, Interactive
// design of bonsai tree models, §2.4 and §3.
#pragma once
#include <array>
#include <string>
#include <vector>

namespace espalier {

/// Sides in the order of numbers, seen along the branch from its base: right, up, left, down. Of a branch
/// that is upright "up" is away from its parent.
struct BranchCrown {
  std::array<float, 4> radius{0.3f, 0.3f, 0.3f, 0.3f};  ///< of the rim, over the length from base to tip
  std::array<float, 4> rim{0.5f, 0.5f, 0.5f, 0.5f};  ///< where the rim is there, 0 at the base, 1 at the tip
  float shape_tip = 2, shape_base = 2;               ///< as CrownShape's: 1 a cone, 2 an ellipsoid
  bool operator==(const BranchCrown&) const = default;
};

/// A number of a crown, as files name it.
struct BranchCrownNumber {
  std::string name;
  float* number;
  float lower, upper;  ///< valid values, both ends included
};

/// All of them.
std::vector<BranchCrownNumber> numbers_of(BranchCrown& crown);

/// Names that stand for several numbers: "radius" and "rim" for those of all sides, "shape" for both.
std::vector<std::string> names_of_several();

}  // namespace espalier
