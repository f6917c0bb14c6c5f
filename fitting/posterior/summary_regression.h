// From many summaries to few: networks predict the unknowns from a picture's summaries, and what they predict
// are the summaries that a posterior is computed from. As many as there are unknowns, they hold what the
// picture says of them in the mean. Fearnhead, Prangle, "Constructing summary statistics for approximate
// Bayesian computation" (Journal of the Royal Statistical Society B 74, 2012); with networks: Jiang, Wu,
// Zheng, Wong (Statistica Sinica 27, 2017).
#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include <espalier/fitting/posterior/networks/network_training.h>
#include <espalier/fitting/posterior/normal_scores.h>

namespace espalier {

/// Normal scores of a matrix's columns.
class ColumnScores {
 public:
  explicit ColumnScores(const Eigen::MatrixXd& columns);
  const NormalScores& operator[](std::size_t column) const { return of_column_[column]; }
  std::size_t size() const { return of_column_.size(); }
  Eigen::MatrixXd scores(const Eigen::MatrixXd& columns) const;

 private:
  std::vector<NormalScores> of_column_;
};

/// Parts that the draws fall into, row by row in turn: each has a network that learnt from all others, so it
/// is as far from the truth of a part's draws as from that of a picture (Vovk, "Cross-conformal predictors",
/// Annals of Mathematics and Artificial Intelligence 74, 2015). Of every kWitnesses draws one is seen by
/// none.
inline constexpr std::size_t kParts = 4, kWitnesses = 21;

/// What was chosen by measurement (experiments/posterior_calibration.md).
TrainingSettings posterior_training();

class SummaryRegression {
 public:
  /// Scores of summaries and of unknowns, a row a draw. The same for any number of threads (0: one a
  /// processor).
  SummaryRegression(const Eigen::MatrixXd& summary_scores, const Eigen::MatrixXd& unknown_scores,
                    const TrainingSettings& training, int threads);
  /// Rows of a table of so many that no network has seen.
  static std::vector<Eigen::Index> witnesses(Eigen::Index rows);
  /// Predicted scores of the unknowns, a row a part: by its network.
  Eigen::MatrixXd predict(const Eigen::RowVectorXd& summary_scores) const;
  /// Of the draws, a row each, by the network of its part.
  const Eigen::MatrixXd& predictions_of_draws() const { return of_draws_; }
  /// The mean of the parts' predictions is nearer to the truth than each of them: how much smaller its errors
  /// are, of each unknown, from plants that no network has seen.
  const Eigen::RowVectorXd& shrinkage() const { return shrinkage_; }
  /// Predictions turned to their principal components and scaled to unit variance over the draws: where
  /// distances are measured. At most as many columns as unknowns, those that differ.
  Eigen::MatrixXd points(const Eigen::MatrixXd& predictions) const { return predictions * whitening_; }

 private:
  std::array<Network, kParts> networks_;
  Eigen::MatrixXd of_draws_, whitening_;
  Eigen::RowVectorXd shrinkage_;
};

}  // namespace espalier
