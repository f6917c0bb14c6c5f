// From many summaries to few: ridge regression predicts the unknowns from a picture's summaries, and what it
// predicts are the summaries that a posterior is computed from. As many as there are unknowns, they hold what
// the picture says of them in the mean. Fearnhead, Prangle, "Constructing summary statistics for approximate
// Bayesian computation" (Journal of the Royal Statistical Society B 74, 2012).
#pragma once
#include <Eigen/Core>
#include <vector>

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

/// Scores of summaries → what is regressed on: the scores, their squares, and the products of their first
/// principal components.
class SummaryFeatures {
 public:
  /// `scores`: a row a draw.
  explicit SummaryFeatures(const Eigen::MatrixXd& scores);
  Eigen::MatrixXd features(const Eigen::MatrixXd& scores) const;

 private:
  Eigen::MatrixXd raw_features(const Eigen::MatrixXd& scores) const;

  Eigen::MatrixXd components_;           ///< columns: principal axes
  Eigen::RowVectorXd mean_, deviation_;  ///< of the raw features
};

class SummaryRegression {
 public:
  /// Scores of summaries and of unknowns, a row a draw.
  SummaryRegression(const Eigen::MatrixXd& summary_scores, const Eigen::MatrixXd& unknown_scores);
  /// Predicted scores of the unknowns, a row a row.
  Eigen::MatrixXd predict(const Eigen::MatrixXd& summary_scores) const;
  /// The same of the draws themselves, each by a regression without it and a fifth of the others: as far from
  /// the truth as that of a picture which the regression has not seen.
  const Eigen::MatrixXd& predictions_of_draws() const { return of_draws_; }
  /// Predictions turned to their principal components and scaled to unit variance over the draws: where
  /// distances are measured. At most as many columns as unknowns, those that differ.
  Eigen::MatrixXd points(const Eigen::MatrixXd& predictions) const { return predictions * whitening_; }

 private:
  SummaryFeatures features_;
  Eigen::RowVectorXd mean_;       ///< of the unknowns' scores
  Eigen::MatrixXd coefficients_;  ///< features → predictions
  Eigen::MatrixXd of_draws_, whitening_;
};

}  // namespace espalier
