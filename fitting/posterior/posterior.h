// The posterior of a picture from a table of draws of the prior: the draws whose summaries lie closest, moved
// by local linear regression to where they would be had they shown the very picture, and weighted by how
// close they were. Beaumont, Zhang, Balding, "Approximate Bayesian computation in population genetics"
// (Genetics 162, 2002); the summaries are predictions of the unknowns (summary_regression.h). All in normal
// scores of the table.
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include <espalier/fitting/posterior/interval_factors.h>
#include <espalier/fitting/posterior/summary_regression.h>

namespace espalier {

/// Weighted draws, a row each.
struct Posterior {
  std::vector<std::size_t> draws;  ///< rows of the table, the closest first
  Eigen::VectorXd weights;         ///< their sum is 1
  Eigen::MatrixXd unknowns;        ///< values, a column an unknown
};

/// Draws that a posterior needs: fewer than these near ones span the summaries badly.
inline constexpr std::size_t kLeastTableSize = 2000;

/// Of one table and many pictures.
class PosteriorEstimator {
 public:
  /// A row a draw in both; throws InputError for fewer than kLeastTableSize rows.
  /// The same for any number of threads (0: one a processor).
  PosteriorEstimator(const Eigen::MatrixXd& unknowns, const Eigen::MatrixXd& summaries,
                     const TrainingSettings& training = posterior_training(), int threads = 0);

  /// `summaries`: of the picture, in the order of the table's columns.
  Posterior estimate(const std::vector<double>& summaries) const;
  /// The value with this share of the table's draws below it.
  double prior_quantile(std::size_t unknown, double share) const;
  /// The share of the table's draws below the value.
  double prior_share(std::size_t unknown, double value) const;

 private:
  /// Scores of the unknowns; `itself`: the table's row that shows the picture, or -1.
  Posterior scores_near(const Eigen::RowVectorXd& summary_scores, Eigen::Index itself) const;
  std::vector<IntervalFactors> factors_from_witnesses(const Eigen::MatrixXd& unknown_scores,
                                                      const Eigen::MatrixXd& summary_scores,
                                                      int threads) const;

  ColumnScores unknown_scores_of_, summary_scores_of_;
  SummaryRegression regression_;
  Eigen::MatrixXd residuals_;  ///< scores of the draws' unknowns, less their predictions
  Eigen::MatrixXd points_;     ///< of the draws' predictions
  Eigen::RowVectorXd lowest_,
      highest_;  ///< nearly all predictions: a picture beyond is taken to be at the end
  std::vector<IntervalFactors> factors_;  ///< of the distances of draws from their median
};

/// The value below which `share` of the weight lies, linear between the middles of the draws' weights.
double posterior_quantile(const Posterior& posterior, std::size_t unknown, double share);

/// The share of the weight below the value, with half of what lies on it.
double posterior_share(const Posterior& posterior, std::size_t unknown, double value);

/// `count` rows of the posterior with equal weights: systematic resampling (Kitagawa 1996) from the middle,
/// so without random numbers.
std::vector<std::size_t> equal_draws(const Posterior& posterior, std::size_t count);

}  // namespace espalier
