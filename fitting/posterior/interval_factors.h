// How much wider intervals must be to hold as many truths as they say, counted where the truth is known: by
// the ranks of truths among the draws of their posteriors. Kuleshov, Fenner, Ermon, "Accurate uncertainties
// for deep learning using calibrated regression" (ICML 2018). What chance makes of a count is taken off, so
// that intervals which are right stay as they are: the positive part of James and Stein's estimate (1961).
#pragma once
#include <array>
#include <vector>

namespace espalier {

/// Central intervals that are told.
inline constexpr std::array<double, 3> kIntervals{0.5, 0.8, 0.9};

/// Of the ends of each of kIntervals, as distances from the median.
using IntervalFactors = std::array<double, kIntervals.size()>;

/// `shares`: of the draws below the truth, 0 to 1, one a posterior. All 1 without any.
IntervalFactors interval_factors(std::vector<double> shares);

/// For a draw at this normal score of its rank: linear between the intervals' ends, constant beyond.
double factor_at(const IntervalFactors& factors, double score);

}  // namespace espalier
