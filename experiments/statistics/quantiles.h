// Quantiles of a sample by linear interpolation between order statistics: type 7 of Hyndman, Fan, "Sample
// Quantiles in Statistical Packages" (The American Statistician 50, 1996), the default of R and NumPy.
#pragma once
#include <span>

namespace espalier {

/// The p-quantile, p in [0, 1], of values in any order: at position p·(n - 1) of the sorted values, counted
/// from 0. NaN where there are no values. A p outside [0, 1] or a value that is NaN: InternalError.
double quantile(std::span<const double> values, double p);

double median(std::span<const double> values);

}  // namespace espalier
