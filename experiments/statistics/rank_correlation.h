// How alike two measures rank the same candidates.
#pragma once
#include <span>

namespace espalier {

/// Spearman's rho: Pearson's correlation of the ranks, equal values sharing the mean of theirs (Spearman
/// 1904). In [-1, 1]; NaN where all values of either are equal, or there are fewer than two. Both have the
/// same length (checked: InternalError) and hold no NaN.
double spearman_rho(std::span<const double> a, std::span<const double> b);

}  // namespace espalier
