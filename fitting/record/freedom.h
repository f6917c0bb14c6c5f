// How far single branches may leave what the model draws for them, as one number. The picture says nothing of
// a plant's other sides: a branch that bends and turns as it likes to meet a gap of the silhouette is seen
// from there. At 0 branches keep to the model's draws and only get other random numbers, or go; at 1 they
// have a quarter of the ranges that they have at 4 and beyond, where a number more costs nothing. Measured in
// experiments/closeness.md.
#pragma once
#include <algorithm>

namespace espalier {

inline constexpr double kWholeFreedom = 4;
inline constexpr int kFreedomOfKind = -1;  ///< in a record: as much as the kind of tree needs

struct Freedom {
  double share = 1;  ///< of the ranges of a branch's offsets, 0 … 1
  double price = 0;  ///< in dissimilarity, of each number that a branch has of its own
};

/// What a number gains must be more than this, at the least freedom: a twentieth of a pixel of a tree of
/// 4,000.
inline constexpr double kDearestNumber = 1.2e-5;

constexpr Freedom freedom_of(double freedom) {
  const double share = std::clamp(freedom / kWholeFreedom, 0.0, 1.0);
  return {share, kDearestNumber * (1 - share)};
}

}  // namespace espalier
