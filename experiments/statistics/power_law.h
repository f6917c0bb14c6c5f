// How time grows with size: time = factor · size^exponent, by least squares of log time on log size.
#pragma once
#include <cstddef>
#include <span>

namespace espalier {

struct PowerLaw {
  double exponent = 0;
  double standard_error = 0;  ///< of the exponent; NaN with fewer than three points, or than two clusters
  double factor = 0;          ///< the time at size 1, in the unit of the times
  std::size_t points = 0;     ///< pairs that were used
};

/// Pairs of which either is not positive have no logarithm and are left out. Exponent and factor are NaN
/// where fewer than two sizes differ. Both have the same length (checked: InternalError).
PowerLaw fit_power_law(std::span<const double> sizes, std::span<const double> times);

/// The same line, for pairs of which those with one number in `clusters` have more in common, as trees of a
/// species: the standard error is that of as many independent clusters, whatever goes on inside of them
/// (Liang, Zeger 1986; with the correction G/(G-1)·(n-1)/(n-2) for G clusters of n pairs, Cameron, Miller
/// 2015, equation 12).
PowerLaw fit_power_law(std::span<const double> sizes, std::span<const double> times,
                       std::span<const std::size_t> clusters);

}  // namespace espalier
