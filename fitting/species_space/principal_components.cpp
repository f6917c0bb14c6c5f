#include <Eigen/SVD>
#include <cmath>

#include <espalier/core/field_error.h>
#include <espalier/fitting/species_space/principal_components.h>

namespace espalier {

namespace {

using Eigen::Index;

/// Mean and deviation of one column over the rows where it means something; all the same: exactly that value.
void measure_column(const Eigen::MatrixXd& rows, const Gaps& means, Index column, PrincipalComponents& pca) {
  double sum = 0, squares = 0, lowest = INFINITY, highest = -INFINITY;
  Index count = 0;
  for (Index row = 0; row < rows.rows(); ++row) {
    if (!means(row, column)) continue;
    sum += rows(row, column), ++count;
    lowest = std::min(lowest, rows(row, column));
    highest = std::max(highest, rows(row, column));
  }
  pca.deviation[column] = 0;
  pca.mean[column] = count == 0 ? rows(0, column) : lowest;
  if (count == 0 || !(highest > lowest)) return;
  pca.mean[column] = sum / static_cast<double>(count);
  for (Index row = 0; row < rows.rows(); ++row)
    if (means(row, column)) squares += std::pow(rows(row, column) - pca.mean[column], 2);
  pca.deviation[column] = std::sqrt(squares / static_cast<double>(count));
}

void turn_positive(Eigen::MatrixXd& components) {
  constexpr double kEqual = 1e-9;  // of entries that only rounding tells apart: the first one counts
  for (Index i = 0; i < components.rows(); ++i) {
    const double largest = components.row(i).cwiseAbs().maxCoeff();
    Index at = 0;
    while (std::fabs(components(i, at)) < largest * (1 - kEqual)) ++at;
    if (components(i, at) < 0) components.row(i) *= -1;
  }
}

Index rank_of(const Eigen::VectorXd& singular) {
  constexpr double kNothing = 1e-10;
  Index rank = 0;
  while (rank < singular.size() && singular[rank] > kNothing * singular[0]) ++rank;
  return rank;
}

}  // namespace

PrincipalComponents principal_components(const Eigen::MatrixXd& rows, const Gaps& means, int count) {
  if (rows.rows() < 2) throw_input_error("presets: got {}, expected at least 2", rows.rows());
  PrincipalComponents pca;
  pca.mean.resize(rows.cols());
  pca.deviation.resize(rows.cols());
  for (Index column = 0; column < rows.cols(); ++column) measure_column(rows, means, column, pca);
  if ((pca.deviation.array() == 0).all())
    throw_input_error("presets: got {} with the same values in all columns, expected some that differ",
                      rows.rows());
  Eigen::MatrixXd standard(rows.rows(), rows.cols());
  for (Index row = 0; row < rows.rows(); ++row)
    standard.row(row) = standardised(pca, rows.row(row), means.row(row));
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(standard, Eigen::ComputeThinV);
  const Index rank = rank_of(svd.singularValues());
  if (count < 1 || count > rank)
    throw_field_error("components", "got {}, expected 1 … {}, the rank of these {} presets", count, rank,
                      rows.rows());
  pca.variance = svd.singularValues().head(rank).array().square() / static_cast<double>(rows.rows());
  pca.components = svd.matrixV().leftCols(count).transpose();
  turn_positive(pca.components);
  return pca;
}

Eigen::VectorXd standardised(const PrincipalComponents& pca, const Eigen::VectorXd& row,
                             const Eigen::Array<bool, Eigen::Dynamic, 1>& means) {
  Eigen::VectorXd standard = Eigen::VectorXd::Zero(row.size());
  for (Index i = 0; i < row.size(); ++i)
    if (means[i] && pca.deviation[i] > 0) standard[i] = (row[i] - pca.mean[i]) / pca.deviation[i];
  return standard;
}

Eigen::VectorXd project(const PrincipalComponents& pca, const Eigen::VectorXd& standard_row) {
  return pca.components * standard_row;
}

Eigen::VectorXd reconstruct(const PrincipalComponents& pca, const Eigen::VectorXd& coordinates) {
  return pca.mean + pca.deviation.cwiseProduct(pca.components.transpose() * coordinates);
}

}  // namespace espalier
