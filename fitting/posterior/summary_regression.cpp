#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include <espalier/fitting/posterior/summary_regression.h>

namespace espalier {

namespace {

constexpr Eigen::Index kProductsOf = 20;  ///< principal components that are multiplied
constexpr double kRidge = 1e-2;           ///< of the variance of a feature
constexpr double kLeastVariance = 1e-4;   ///< of a prediction's component, where scores have 1

/// Axes of the largest variance first, and these variances.
struct Axes {
  Eigen::MatrixXd vectors;
  Eigen::VectorXd variances;
};

/// Of centred columns.
Axes principal_axes(const Eigen::MatrixXd& centred) {
  const Eigen::MatrixXd covariance = centred.transpose() * centred / static_cast<double>(centred.rows());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance);
  return {solver.eigenvectors().rowwise().reverse(), solver.eigenvalues().reverse()};
}

Eigen::MatrixXd centred(const Eigen::MatrixXd& columns) {
  return columns.rowwise() - columns.colwise().mean();
}

}  // namespace

ColumnScores::ColumnScores(const Eigen::MatrixXd& columns) {
  of_column_.reserve(static_cast<std::size_t>(columns.cols()));
  for (Eigen::Index column = 0; column < columns.cols(); ++column)
    of_column_.emplace_back(std::span(columns.col(column).data(), static_cast<std::size_t>(columns.rows())));
}

Eigen::MatrixXd ColumnScores::scores(const Eigen::MatrixXd& columns) const {
  Eigen::MatrixXd scores(columns.rows(), columns.cols());
  for (Eigen::Index column = 0; column < columns.cols(); ++column)
    for (Eigen::Index row = 0; row < columns.rows(); ++row)
      scores(row, column) = of_column_[static_cast<std::size_t>(column)].score(columns(row, column));
  return scores;
}

SummaryFeatures::SummaryFeatures(const Eigen::MatrixXd& scores) {
  const Eigen::Index products_of = std::min(kProductsOf, scores.cols());
  const Axes axes = principal_axes(centred(scores));
  const Eigen::VectorXd lengths = axes.variances.head(products_of).cwiseMax(1e-12).cwiseSqrt();
  components_ = axes.vectors.leftCols(products_of) * lengths.cwiseInverse().asDiagonal();
  const Eigen::MatrixXd raw = raw_features(scores);
  mean_ = raw.colwise().mean();
  deviation_ = (raw.rowwise() - mean_).colwise().squaredNorm() / static_cast<double>(raw.rows());
  deviation_ = deviation_.cwiseSqrt().cwiseMax(1e-9);
}

Eigen::MatrixXd SummaryFeatures::raw_features(const Eigen::MatrixXd& scores) const {
  const Eigen::MatrixXd components = scores * components_;
  const Eigen::Index pairs = components.cols() * (components.cols() - 1) / 2;
  Eigen::MatrixXd features(scores.rows(), 2 * scores.cols() + pairs);
  features.leftCols(scores.cols()) = scores;
  features.middleCols(scores.cols(), scores.cols()) = scores.cwiseAbs2();
  Eigen::Index column = 2 * scores.cols();
  for (Eigen::Index i = 0; i < components.cols(); ++i)
    for (Eigen::Index j = 0; j < i; ++j)
      features.col(column++) = components.col(i).cwiseProduct(components.col(j));
  return features;
}

Eigen::MatrixXd SummaryFeatures::features(const Eigen::MatrixXd& scores) const {
  return (raw_features(scores).rowwise() - mean_).array().rowwise() / deviation_.array();
}

namespace {

constexpr Eigen::Index kFolds = 5;

Eigen::MatrixXd rows_of_fold(const Eigen::MatrixXd& matrix, Eigen::Index fold) {
  return matrix(Eigen::seq(fold, Eigen::last, kFolds), Eigen::all);
}

/// Ridge regression by its normal equations, sums over `draws` rows.
Eigen::MatrixXd solve_ridge(Eigen::MatrixXd products, const Eigen::MatrixXd& with_unknowns, double draws) {
  products /= draws;
  products.diagonal().array() += kRidge;
  return products.ldlt().solve(with_unknowns / draws);
}

}  // namespace

SummaryRegression::SummaryRegression(const Eigen::MatrixXd& summary_scores,
                                     const Eigen::MatrixXd& unknown_scores)
    : features_(summary_scores), mean_(unknown_scores.colwise().mean()) {
  const Eigen::MatrixXd features = features_.features(summary_scores), unknowns = centred(unknown_scores);
  const Eigen::MatrixXd products = features.transpose() * features,
                        with_unknowns = features.transpose() * unknowns;
  of_draws_.resize(unknowns.rows(), unknowns.cols());
  for (Eigen::Index fold = 0; fold < kFolds; ++fold) {
    const Eigen::MatrixXd left_out = rows_of_fold(features, fold);
    const Eigen::MatrixXd coefficients =
        solve_ridge(products - left_out.transpose() * left_out,
                    with_unknowns - left_out.transpose() * rows_of_fold(unknowns, fold),
                    static_cast<double>(features.rows() - left_out.rows()));
    of_draws_(Eigen::seq(fold, Eigen::last, kFolds), Eigen::all) =
        (left_out * coefficients).rowwise() + mean_;
  }
  const Axes axes = principal_axes(centred(of_draws_));
  Eigen::Index kept = 0;
  while (kept < axes.variances.size() && axes.variances[kept] > kLeastVariance) ++kept;
  whitening_ =
      axes.vectors.leftCols(kept) * axes.variances.head(kept).cwiseSqrt().cwiseInverse().asDiagonal();
  coefficients_ = solve_ridge(products, with_unknowns, static_cast<double>(features.rows()));
}

Eigen::MatrixXd SummaryRegression::predict(const Eigen::MatrixXd& summary_scores) const {
  return (features_.features(summary_scores) * coefficients_).rowwise() + mean_;
}

}  // namespace espalier
