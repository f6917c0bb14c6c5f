// Do optimisers differ? Ranks within blocks (a block is a target, or a target and a seed), Friedman's test,
// Iman and Davenport's F, and which pairs differ by Nemenyi's critical difference; all as in Demšar,
// "Statistical Comparisons of Classifiers over Multiple Data Sets" (J. Mach. Learn. Res. 7, 2006). Rank 1 is
// the highest value.
#pragma once
#include <span>
#include <string>
#include <vector>

namespace espalier {

/// [block][treatment]: what each treatment reached in each block, e.g. fitness. NaN: it failed there, and
/// ranks last. Every block has the same treatments, at least two (checked: InternalError).
using BlockValues = std::vector<std::vector<double>>;

/// Ranks of the values, 1 for the highest; equal values share the mean of their ranks, and so do all NaN.
std::vector<double> average_ranks(std::span<const double> values);

/// The mean of each treatment's ranks over the blocks (at least one).
std::vector<double> mean_ranks(const BlockValues& blocks);

struct FriedmanTest {
  std::size_t blocks = 0, treatments = 0;
  double chi_squared = 0;         ///< corrected for ties
  double degrees_of_freedom = 0;  ///< treatments - 1
  double p_value = 1;
  double iman_davenport_f = 0;  ///< infinite where all blocks rank alike
  double iman_davenport_p = 1;
};

/// Without any difference in any block (all values tied): chi_squared 0, p 1. With one block the F is NaN.
FriedmanTest friedman_test(const BlockValues& blocks);

/// The quantile of the studentised range at infinite degrees of freedom, divided by √2: q_α of Demšar 2006,
/// Table 5. At least two treatments, alpha in (0, 1): InternalError otherwise.
double nemenyi_quantile(std::size_t treatments, double alpha);

/// Mean ranks further apart than this differ (Nemenyi 1963).
double nemenyi_critical_difference(std::size_t treatments, std::size_t blocks, double alpha = 0.05);

/// Groups as letters, in the order of `mean_ranks`: two that share a letter do not differ by more than the
/// critical difference; every two that share none do. "a" is in the group of the best; after "z" come "a2",
/// "b2" …
std::vector<std::string> rank_groups(std::span<const double> mean_ranks, double critical_difference);

}  // namespace espalier
