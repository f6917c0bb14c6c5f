#include <Eigen/Eigenvalues>
#include <algorithm>

#include <espalier/core/parallel_for.h>
#include <espalier/fitting/posterior/summary_regression.h>

namespace espalier {

namespace {

constexpr double kLeastVariance = 1e-4;  ///< of a prediction's component, where scores have 1

using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

FloatMatrix to_floats(const Eigen::MatrixXd& matrix) {
  FloatMatrix floats(static_cast<std::size_t>(matrix.rows()), static_cast<std::size_t>(matrix.cols()));
  Eigen::Map<RowMajor>(floats.numbers.data(), matrix.rows(), matrix.cols()) = matrix.cast<float>();
  return floats;
}

Eigen::MatrixXd to_doubles(const FloatMatrix& floats) {
  return Eigen::Map<const RowMajor>(floats.numbers.data(), static_cast<Eigen::Index>(floats.rows),
                                    static_cast<Eigen::Index>(floats.columns))
      .cast<double>();
}

bool is_witness(Eigen::Index row) { return static_cast<std::size_t>(row) % kWitnesses == kWitnesses - 1; }

bool is_of_part(Eigen::Index row, std::size_t part) { return static_cast<std::size_t>(row) % kParts == part; }

template <typename Chosen>
std::vector<Eigen::Index> rows_where(Eigen::Index rows, const Chosen& chosen) {
  std::vector<Eigen::Index> result;
  result.reserve(static_cast<std::size_t>(rows));
  for (Eigen::Index row = 0; row < rows; ++row)
    if (chosen(row)) result.push_back(row);
  return result;
}

/// To principal components of unit variance, the largest first.
Eigen::MatrixXd whitening_of(const Eigen::MatrixXd& predictions) {
  const Eigen::MatrixXd centred = predictions.rowwise() - predictions.colwise().mean();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(centred.transpose() * centred /
                                                              static_cast<double>(centred.rows()));
  const Eigen::MatrixXd vectors = solver.eigenvectors().rowwise().reverse();
  const Eigen::VectorXd variances = solver.eigenvalues().reverse();
  const Eigen::Index kept = std::max<Eigen::Index>(1, (variances.array() > kLeastVariance).count());
  return vectors.leftCols(kept) *
         variances.head(kept).cwiseMax(kLeastVariance).cwiseSqrt().cwiseInverse().asDiagonal();
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

namespace {

Network network_of_part(const Eigen::MatrixXd& summary_scores, const Eigen::MatrixXd& unknown_scores,
                        const TrainingSettings& training, std::size_t part) {
  const std::vector<Eigen::Index> others = rows_where(
      summary_scores.rows(), [&](Eigen::Index row) { return !is_of_part(row, part) && !is_witness(row); });
  return train_network(to_floats(summary_scores(others, Eigen::all)),
                       to_floats(unknown_scores(others, Eigen::all)), training, child_key(root_key(0), part));
}

/// Errors of the mean of all networks beside those of each, over the witnesses.
Eigen::RowVectorXd shrinkage_of(const std::array<Network, kParts>& networks,
                                const Eigen::MatrixXd& summary_scores,
                                const Eigen::MatrixXd& unknown_scores) {
  const std::vector<Eigen::Index> witnesses = rows_where(summary_scores.rows(), is_witness);
  const FloatMatrix inputs = to_floats(summary_scores(witnesses, Eigen::all));
  const Eigen::MatrixXd truths = unknown_scores(witnesses, Eigen::all);
  Eigen::MatrixXd of_mean = Eigen::MatrixXd::Zero(truths.rows(), truths.cols());
  Eigen::RowVectorXd of_each = Eigen::RowVectorXd::Constant(truths.cols(), 1e-12);
  for (const Network& network : networks) {
    const Eigen::MatrixXd errors = to_doubles(espalier::predict(network, inputs)) - truths;
    of_mean += errors / static_cast<double>(kParts);
    of_each += errors.colwise().squaredNorm() / static_cast<double>(kParts);
  }
  return (of_mean.colwise().squaredNorm().array() / of_each.array()).sqrt();
}

}  // namespace

TrainingSettings posterior_training() {
  return {
      .hidden = {256, 256, 256}, .epochs = 20, .batch = 128, .dropout = 0.1F, .step = 3e-3F, .decay = 0.01F};
}

SummaryRegression::SummaryRegression(const Eigen::MatrixXd& summary_scores,
                                     const Eigen::MatrixXd& unknown_scores, const TrainingSettings& training,
                                     int threads) {
  const Eigen::Index rows = summary_scores.rows();
  parallel_for(
      kParts,
      [&](std::size_t part) {
        networks_[part] = network_of_part(summary_scores, unknown_scores, training, part);
      },
      threads);
  of_draws_.resize(rows, unknown_scores.cols());
  for (std::size_t part = 0; part < kParts; ++part) {
    const std::vector<Eigen::Index> own =
        rows_where(rows, [&](Eigen::Index row) { return is_of_part(row, part); });
    of_draws_(own, Eigen::all) =
        to_doubles(espalier::predict(networks_[part], to_floats(summary_scores(own, Eigen::all))));
  }
  whitening_ = whitening_of(of_draws_);
  shrinkage_ = shrinkage_of(networks_, summary_scores, unknown_scores);
}

std::vector<Eigen::Index> SummaryRegression::witnesses(Eigen::Index rows) {
  return rows_where(rows, is_witness);
}

Eigen::MatrixXd SummaryRegression::predict(const Eigen::RowVectorXd& summary_scores) const {
  Eigen::MatrixXd predictions(kParts, of_draws_.cols());
  const FloatMatrix inputs = to_floats(summary_scores);
  for (std::size_t part = 0; part < kParts; ++part)
    predictions.row(static_cast<Eigen::Index>(part)) = to_doubles(espalier::predict(networks_[part], inputs));
  return predictions;
}

}  // namespace espalier
