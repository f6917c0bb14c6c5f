// Two classes of colours, each a normal distribution, told apart by expectation maximisation: Dempster,
// Laird, Rubin, Maximum likelihood from incomplete data via the EM algorithm, J. R. Stat. Soc. B 39 (1977).
#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

namespace espalier {

struct ColorClass {
  Eigen::Vector3d mean;
  Eigen::Matrix3d inverse_covariance;
  double log_determinant = 0;  ///< of the covariance

  /// Of the density, without its constant factor.
  double log_density(const Eigen::Vector3d& color) const;
};

/// Of colours with these weights, of which at least one is positive.
ColorClass color_class_of(std::span<const Eigen::Vector3d> colors, std::span<const double> weights);

/// Bhattacharyya's distance, On a measure of divergence between two statistical populations (1943): 0 where
/// both are the same, above 1 where few colours could be of either.
double bhattacharyya_distance(const ColorClass& a, const ColorClass& b);

struct TwoClasses {
  ColorClass known, other;
  double share_of_other = 0.5;  ///< of the mixed colours

  /// Probability that a colour of the mixture is of the other class.
  double other_probability(const Eigen::Vector3d& color) const;
};

/// Splits `mixed` into the class that `sample` (not empty) shows and the class of the rest. The sample stays
/// in its class, and counts for at least a quarter of the mixture.
TwoClasses split_colors(std::span<const Eigen::Vector3d> sample, std::span<const Eigen::Vector3d> mixed);

}  // namespace espalier
