// How time grows with size: time = factor · size^exponent, by least squares of log time on log size.
#pragma once
#include <cstddef>
#include <span>

namespace espalier {

struct PowerLaw {
  double exponent = 0;
  double standard_error = 0;  ///< of the exponent; NaN with fewer than three points
  double factor = 0;          ///< the time at size 1, in the unit of the times
  std::size_t points = 0;     ///< pairs that were used
};

/// Pairs of which either is not positive have no logarithm and are left out. Exponent and factor are NaN
/// where fewer than two sizes differ. Both have the same length (checked: InternalError).
PowerLaw fit_power_law(std::span<const double> sizes, std::span<const double> times);

}  // namespace espalier
