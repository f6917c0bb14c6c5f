// Principal components of small tables, by hand and at random.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <espalier/core/error.h>
#include <espalier/fitting/species_space/principal_components.h>

namespace espalier {
namespace {

using testing::HasSubstr;

Gaps no_gaps(const Eigen::MatrixXd& rows) { return Gaps::Constant(rows.rows(), rows.cols(), true); }

std::string analysis_error(const Eigen::MatrixXd& rows, int count) {
  try {
    principal_components(rows, no_gaps(rows), count);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

Eigen::MatrixXd random_rows(int rows, int columns) {
  Eigen::MatrixXd table(rows, columns);
  for (double& number : table.reshaped()) number = *rc::gen::inRange(-1000, 1001) * 0.01;
  return table;
}

TEST(PrincipalComponents, OfALineIsTheLine) {
  const Eigen::MatrixXd rows{{0, 10}, {1, 12}, {2, 14}, {5, 20}};
  const PrincipalComponents pca = principal_components(rows, no_gaps(rows), 1);
  EXPECT_EQ(pca.variance.size(), 1) << "the rank";
  EXPECT_NEAR(pca.explained(0), 1, 1e-12);
  EXPECT_NEAR(pca.components(0, 0), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(pca.components(0, 1), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(pca.variance.sum(), 2, 1e-12) << "one for each column";
}

RC_GTEST_PROP(PrincipalComponents, AllOfThemGiveEveryRowBack, ()) {
  const Eigen::MatrixXd rows = random_rows(6, 9);
  RC_PRE((rows.colwise().maxCoeff() - rows.colwise().minCoeff()).minCoeff() > 0.1);
  const auto rank = principal_components(rows, no_gaps(rows), 1).variance.size();
  const PrincipalComponents pca = principal_components(rows, no_gaps(rows), static_cast<int>(rank));
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const Eigen::VectorXd row = rows.row(i);
    const auto means = Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(row.size(), true);
    RC_ASSERT((reconstruct(pca, project(pca, standardised(pca, row, means))) - row).cwiseAbs().maxCoeff() <
              1e-9);
  }
}

RC_GTEST_PROP(PrincipalComponents, AreAtRightAnglesAndTheirLargestEntryIsPositive, ()) {
  const Eigen::MatrixXd rows = random_rows(7, 5);
  RC_PRE((rows.colwise().maxCoeff() - rows.colwise().minCoeff()).minCoeff() > 0.1);
  const PrincipalComponents pca = principal_components(rows, no_gaps(rows), 2);
  RC_ASSERT((pca.components * pca.components.transpose() - Eigen::Matrix2d::Identity()).norm() < 1e-9);
  for (int i = 0; i < 2; ++i) {
    const Eigen::VectorXd component = pca.components.row(i);
    RC_ASSERT(component.maxCoeff() >= component.cwiseAbs().maxCoeff() * (1 - 1e-9));
  }
}

TEST(PrincipalComponents, AGapIsTheMeanAndTakesNoPartInIt) {
  const Eigen::MatrixXd rows{{0, 1}, {2, 3}, {1000, 5}};
  Gaps means = no_gaps(rows);
  means(2, 0) = false;
  const PrincipalComponents pca = principal_components(rows, means, 1);
  EXPECT_EQ(pca.mean[0], 1);
  EXPECT_EQ(pca.deviation[0], 1);
  EXPECT_EQ(standardised(pca, rows.row(2), means.row(2))[0], 0);
}

TEST(PrincipalComponents, AConstantColumnIsCarriedAsItIs) {
  const Eigen::MatrixXd rows{{0.1, 1}, {0.1, 3}};
  const PrincipalComponents pca = principal_components(rows, no_gaps(rows), 1);
  EXPECT_EQ(pca.deviation[0], 0);
  EXPECT_EQ(pca.components(0, 0), 0);
  EXPECT_EQ(reconstruct(pca, Eigen::VectorXd::Constant(1, 77))[0], 0.1);
}

TEST(PrincipalComponents, RefuseWhatSpansNothing) {
  EXPECT_THAT(analysis_error(Eigen::MatrixXd{{1, 2}}, 1), HasSubstr("got 1, expected at least 2"));
  EXPECT_THAT(analysis_error(Eigen::MatrixXd{{1, 2}, {1, 2}, {1, 2}}, 1),
              HasSubstr("the same values in all columns"));
  EXPECT_THAT(analysis_error(Eigen::MatrixXd{{1, 2}, {2, 1}}, 2), HasSubstr("got 2, expected 1 … 1"));
  EXPECT_THAT(analysis_error(Eigen::MatrixXd{{1, 2}, {2, 1}}, 0), HasSubstr("got 0"));
}

}  // namespace
}  // namespace espalier
