// How far a point lies outside the convex hull of others, in any number of dimensions: the point of the hull
// nearest to it by Frank and Wolfe's method with away steps (Guélat and Marcotte 1986), which converges
// linearly here.
#pragma once
#include <Eigen/Core>

namespace espalier {

/// points: one a column, at least one. The distance to the hull to about 1e-6 of the size of the set; 0
/// inside.
double distance_to_hull(const Eigen::MatrixXd& points, const Eigen::VectorXd& point);

}  // namespace espalier
