// Principal components of a table with gaps: the singular value decomposition of the standardised matrix
// (Jolliffe, Principal Component Analysis, 2nd ed. 2002, §3.5). Each column is shifted by its mean and
// divided by its standard deviation, both over the rows where it means something; a gap then is 0, the mean.
// A column that is the same in all rows is carried as it is and takes no part. The largest entry of each
// component is positive (the first of equals), so that maps are the same on every machine.
#pragma once
#include <Eigen/Core>
#include <string>

namespace espalier {

using Gaps = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>;

struct PrincipalComponents {
  Eigen::VectorXd mean, deviation;  ///< of each column; deviation 0: the column is constant
  Eigen::MatrixXd components;       ///< a row a component, of unit length, at right angles; a column a column
  Eigen::VectorXd variance;         ///< along all directions there are, largest first; their sum is the whole
  int count() const { return static_cast<int>(components.rows()); }
  /// The share of the variance that lies along component `index`.
  double explained(int index) const { return variance[index] / variance.sum(); }
};

/// rows: a plant a row; means: false where a number means nothing. count: components to keep, at least 1.
/// Throws InputError for fewer than two rows, where no column varies, or count is above the rank.
PrincipalComponents principal_components(const Eigen::MatrixXd& rows, const Gaps& means, int count);

/// Deviations from the mean in standard deviations; 0 in gaps and constant columns.
Eigen::VectorXd standardised(const PrincipalComponents& pca, const Eigen::VectorXd& row,
                             const Eigen::Array<bool, Eigen::Dynamic, 1>& means);

/// Coordinates of a standardised row.
Eigen::VectorXd project(const PrincipalComponents& pca, const Eigen::VectorXd& standard_row);

/// The row at these coordinates, in the columns' own units.
Eigen::VectorXd reconstruct(const PrincipalComponents& pca, const Eigen::VectorXd& coordinates);

}  // namespace espalier
