// Numbers by their place among others: the score of a value is the standard normal quantile of its share of
// smaller ones (van der Waerden 1952). Skewed measures, counts and measures with bounds become alike, and
// what is computed with scores can be taken back to values that occur.
#pragma once
#include <span>
#include <vector>

namespace espalier {

class NormalScores {
 public:
  /// Of these values, at least two, none of them NaN.
  explicit NormalScores(std::span<const double> values);

  /// Equal values share the middle of their places. Beyond all values the score is that of half a place
  /// outside.
  double score(double value) const;
  /// The inverse, linear between neighbouring values and never beyond them.
  double value(double score) const;

 private:
  std::vector<double> sorted_;
};

/// Standard normal: the share below `score`, and the score with this share below, share in (0, 1).
double normal_share(double score);
double normal_quantile(double share);

}  // namespace espalier
