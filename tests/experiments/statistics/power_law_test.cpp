#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <vector>

#include <espalier/core/error.h>
#include <espalier/experiments/statistics/power_law.h>

namespace espalier {
namespace {

PowerLaw fit(const std::vector<double>& sizes, const std::vector<double>& times) {
  return fit_power_law(sizes, times);
}

RC_GTEST_PROP(PowerLaw, OfExactDataIsThatLaw, ()) {
  const double exponent = *rc::gen::inRange(-30, 30) / 10.0, factor = *rc::gen::inRange(1, 1000) / 100.0;
  std::vector<double> sizes, times;
  for (const double size : {3.0, 70.0, 900.0, 1e5}) {
    sizes.push_back(size);
    times.push_back(factor * std::pow(size, exponent));
  }
  const PowerLaw law = fit(sizes, times);
  RC_ASSERT(std::abs(law.exponent - exponent) < 1e-12);
  RC_ASSERT(std::abs(law.factor / factor - 1) < 1e-10);
  RC_ASSERT(law.standard_error < 1e-6);
  RC_ASSERT(law.points == 4u);
}

// log size 0 1 2 3, log time 0 2 1 3: slope 4/5, intercept 0.3, residuals -0.3 0.9 -0.9 0.3 (sum of
// squares 1.8), standard error √(1.8 / 2 / 5).
TEST(PowerLaw, OfScatteredDataIsTheLineOfLeastSquares) {
  const double e = std::exp(1);
  const PowerLaw law = fit({1, e, e * e, e * e * e}, {1, e * e, e, e * e * e});
  EXPECT_NEAR(law.exponent, 0.8, 1e-12);
  EXPECT_NEAR(law.factor, std::exp(0.3), 1e-12);
  EXPECT_NEAR(law.standard_error, std::sqrt(1.8 / 2 / 5), 1e-12);
}

// The sandwich written out with NumPy.
TEST(PowerLaw, OfClustersHasTheErrorOfClusters) {
  const std::vector<double> sizes{1, 2, 4, 8, 3, 9, 27}, times{2, 3.7, 9.1, 15, 6.5, 17, 60};
  const PowerLaw law = fit_power_law(sizes, times, std::vector<std::size_t>{0, 0, 0, 0, 1, 1, 2});
  EXPECT_NEAR(law.exponent, 1.0174310525163222, 1e-12);
  EXPECT_NEAR(law.standard_error, 0.02559126069832717, 1e-12);
  EXPECT_TRUE(std::isnan(fit_power_law(sizes, times, std::vector<std::size_t>(7, 5)).standard_error));
}

TEST(PowerLaw, TheSamePairsAgainInTheirClustersTellNoMore) {
  const auto errors = [](std::size_t copies) {
    std::vector<double> sizes, times;
    std::vector<std::size_t> clusters;
    for (std::size_t i = 0; i < 12 * copies; ++i) {
      clusters.push_back(i / copies);
      sizes.push_back(std::exp(0.5 * double(i / copies)));
      times.push_back(sizes.back() * (i / copies % 3 == 0 ? 1.5 : 0.8));
    }
    return std::pair(fit_power_law(sizes, times, clusters).standard_error, fit(sizes, times).standard_error);
  };
  const auto [clustered, plain] = errors(1);
  const auto [clustered_of_ten, plain_of_ten] = errors(10);
  EXPECT_NEAR(clustered_of_ten / clustered, std::sqrt(119.0 / 118 * 10 / 11), 1e-9) << "(n-1)/(n-2) alone";
  EXPECT_LT(plain_of_ten, 0.5 * plain);
}

TEST(PowerLaw, LeavesOutWhatHasNoLogarithm) {
  const PowerLaw law = fit({0, 1, 10, 100, 1000}, {5, 2, 20, 0, 2000});
  EXPECT_NEAR(law.exponent, 1, 1e-12);
  EXPECT_EQ(law.points, 3u);
}

TEST(PowerLaw, OfTwoPointsHasNoError) {
  const PowerLaw law = fit({1, 2}, {1, 8});
  EXPECT_NEAR(law.exponent, 3, 1e-12);
  EXPECT_TRUE(std::isnan(law.standard_error));
}

TEST(PowerLaw, OfOneSizeIsNoNumber) {
  EXPECT_TRUE(std::isnan(fit({2, 2, 2}, {1, 8, 9}).exponent));
  EXPECT_TRUE(std::isnan(fit({}, {}).factor));
}

TEST(PowerLaw, RefusesDifferentLengths) { EXPECT_THROW(fit({1, 2}, {1}), InternalError); }

}  // namespace
}  // namespace espalier
