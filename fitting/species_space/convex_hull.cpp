#include <algorithm>

#include <espalier/fitting/species_space/convex_hull.h>

namespace espalier {

namespace {

using Eigen::Index;

/// One step from `weights` towards the best corner, or away from the worst one that has a weight. False once
/// there is nothing to gain.
bool step(const Eigen::MatrixXd& corners, Eigen::VectorXd& weights, double tolerance) {
  const Eigen::VectorXd here = corners * weights;
  const Eigen::VectorXd slope = corners.transpose() * here;
  Index toward = 0, away = 0;
  slope.minCoeff(&toward);
  double worst = -std::numeric_limits<double>::infinity();
  for (Index i = 0; i < weights.size(); ++i)
    if (weights[i] > 0 && slope[i] > worst) worst = slope[i], away = i;
  const double at = here.squaredNorm();
  const double gain_toward = at - slope[toward], gain_away = worst - at;
  if (gain_toward <= tolerance) return false;
  Eigen::VectorXd direction = -weights;
  direction[toward] += 1;
  double longest = 1;
  if (gain_away > gain_toward && weights[away] < 1) {
    direction = weights;
    direction[away] -= 1;
    longest = weights[away] / (1 - weights[away]);
  }
  const Eigen::VectorXd move = corners * direction;
  weights += std::clamp(-here.dot(move) / move.squaredNorm(), 0.0, longest) * direction;
  weights = weights.cwiseMax(0);
  weights /= weights.sum();
  return true;
}

}  // namespace

double distance_to_hull(const Eigen::MatrixXd& points, const Eigen::VectorXd& point) {
  constexpr int kMostSteps = 20'000;
  const Eigen::MatrixXd corners = points.colwise() - point;
  const double size = (points.colwise() - points.rowwise().mean()).colwise().norm().maxCoeff();
  const double tolerance = 1e-12 * size * size;
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(points.cols());
  Index nearest = 0;
  corners.colwise().norm().minCoeff(&nearest);
  weights[nearest] = 1;
  for (int i = 0; i < kMostSteps && step(corners, weights, tolerance); ++i) {
  }
  const double distance = (corners * weights).norm();
  return distance > 2e-6 * size ? distance : 0;
}

}  // namespace espalier
