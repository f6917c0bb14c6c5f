// Distances to convex hulls that are known.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <espalier/fitting/species_space/convex_hull.h>

namespace espalier {
namespace {

const Eigen::MatrixXd kSquare{{0, 2, 2, 0}, {0, 0, 2, 2}};

double distance(double x, double y) { return distance_to_hull(kSquare, Eigen::Vector2d(x, y)); }

TEST(ConvexHull, IsZeroInsideAndOnTheEdge) {
  EXPECT_EQ(distance(1, 1), 0);
  EXPECT_EQ(distance(0.001, 1.9), 0);
  EXPECT_EQ(distance(2, 2), 0);
  EXPECT_EQ(distance(0, 0.7), 0);
}

TEST(ConvexHull, IsTheDistanceToTheNearestEdgeOrCornerOutside) {
  EXPECT_NEAR(distance(5, 1), 3, 1e-5);
  EXPECT_NEAR(distance(5, 6), 5, 1e-5);
  EXPECT_NEAR(distance(-0.25, 0.3), 0.25, 1e-5);
}

TEST(ConvexHull, OfOnePointIsThePoint) {
  EXPECT_NEAR(distance_to_hull(Eigen::MatrixXd{{1}, {2}}, Eigen::Vector2d(4, 6)), 5, 1e-9);
}

RC_GTEST_PROP(ConvexHull, OfACubeInThreeDimensionsIsTheDistanceToTheBox, ()) {
  Eigen::MatrixXd corners(3, 8);
  for (int i = 0; i < 8; ++i) corners.col(i) << (i & 1), (i >> 1 & 1), (i >> 2 & 1);
  Eigen::Vector3d point;
  for (double& x : point) x = *rc::gen::inRange(-3000, 4000) * 1e-3;
  const Eigen::Vector3d nearest = point.cwiseMax(0).cwiseMin(1);
  RC_ASSERT(std::fabs(distance_to_hull(corners, point) - (point - nearest).norm()) < 1e-4);
}

}  // namespace
}  // namespace espalier
