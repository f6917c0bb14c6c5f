// The check: a picture like the replicates is likely, one beyond them all is not.
#include <gtest/gtest.h>

#include <random>

#include <espalier/fitting/posterior/predictive_check.h>

namespace espalier {
namespace {

Eigen::MatrixXd normal_rows(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd matrix(rows, columns);
  for (double& value : matrix.reshaped()) value = normal(random);
  return matrix;
}

TEST(PredictiveCheck, TailSharesOfPicturesLikeTheReplicatesAreUniform) {
  const Eigen::MatrixXd replicates = normal_rows(200, 10, 1), pictures = normal_rows(400, 10, 2);
  int below_tenth = 0, below_half = 0;
  for (const auto& picture : pictures.rowwise()) {
    const PredictiveCheck check = check_prediction(replicates, replicates, {picture.begin(), picture.end()});
    below_tenth += check.tail_share < 0.1;
    below_half += check.tail_share < 0.5;
  }
  EXPECT_NEAR(below_tenth, 40, 30);
  EXPECT_NEAR(below_half, 200, 60);
}

TEST(PredictiveCheck, APictureBeyondAllIsUnlikely) {
  const Eigen::MatrixXd replicates = normal_rows(200, 10, 1);
  const PredictiveCheck check =
      check_prediction(replicates, replicates, std::vector<double>(10, 6));  // each square counts 16
  EXPECT_NEAR(check.tail_share, 1.0 / 201, 1e-12);
  EXPECT_FALSE(check.is_likely());
  EXPECT_NEAR(check.distance, 160, 1e-9);
}

TEST(PredictiveCheck, WhatReplicatesAllShareCountsInUnitsOfTheTable) {
  Eigen::MatrixXd replicates = normal_rows(200, 2, 1);
  replicates.col(1).setZero();
  const Eigen::MatrixXd table = normal_rows(2000, 2, 3);
  EXPECT_TRUE(check_prediction(replicates, table, {0, 0.05}).is_likely());  // a unit is a twentieth
  EXPECT_FALSE(check_prediction(replicates, table, {0, 1}).is_likely());
}

TEST(PredictiveCheck, APictureIsAloneWhereNoPlantIsNear) {
  const Eigen::MatrixXd table = normal_rows(2000, 6, 4), pictures = normal_rows(100, 6, 5);
  int alone = 0;
  for (const auto& picture : pictures.rowwise())
    alone += near_tail_share(table, {picture.begin(), picture.end()}) < 0.1;
  EXPECT_NEAR(alone, 10, 9);
  EXPECT_LE(near_tail_share(table, std::vector<double>(6, 5)), 0.002);
  Eigen::MatrixXd ring = table;  // not beyond any plant in any summary, but where none is
  ring.rowwise().normalize();
  EXPECT_LE(near_tail_share(ring, std::vector<double>(6, 0)), 0.002);
}

TEST(PredictiveCheck, WithoutReplicatesSaysNothing) {
  EXPECT_EQ(check_prediction(Eigen::MatrixXd(0, 2), normal_rows(9, 2, 1), {0, 0}).tail_share, 1);
}

}  // namespace
}  // namespace espalier
