// CMA-ES: the tutorial's numbers, and problems that only a working covariance, step size and box handling
// solve.
#include <gtest/gtest.h>

#include <Eigen/QR>

#include <espalier/fitting/optimizers/cma_distribution.h>

#include "support/test_functions.h"

namespace espalier {
namespace {

using namespace test;

TEST(CmaParameters, AreThoseOfTable1) {
  // Computed from table 1 by an independent script for n = 10, lambda = 10.
  const CmaParameters p = cma_parameters(10, 10);
  EXPECT_EQ(p.mu, 5u);
  EXPECT_NEAR(p.weights.head(5).sum(), 1, 1e-12);
  EXPECT_NEAR(p.weights.tail(5).sum(), -1.6489457144406465, 1e-9);
  EXPECT_NEAR(p.mu_eff, 3.1672992814107017, 1e-9);
  EXPECT_NEAR(p.c_sigma, 0.2844285879463714, 1e-9);
  EXPECT_NEAR(p.d_sigma, 1.2844285879463714, 1e-9);
  EXPECT_NEAR(p.c_c, 0.29499038303562225, 1e-9);
  EXPECT_NEAR(p.c_1, 0.015283824524751714, 1e-9);
  EXPECT_NEAR(p.c_mu, 0.023551776650417484, 1e-9);
  EXPECT_EQ(cma_population(10), 10u);
  EXPECT_EQ(cma_population(1), 4u);
}

TEST(CmaParameters, WeightsFallAndTheirRatesLeaveThePastItsShare) {
  for (std::size_t n : {1u, 2u, 10u, 60u})
    for (std::size_t lambda : {2u, 3u, 4u, 9u, 40u, 1000u}) {
      const CmaParameters p = cma_parameters(n, lambda);
      for (Eigen::Index i = 1; i < p.weights.size(); ++i) EXPECT_LE(p.weights[i], p.weights[i - 1]);
      EXPECT_GT(p.c_1, 0);
      EXPECT_GT(p.c_mu, 0);
      EXPECT_LE(p.c_1 + p.c_mu, 1 + 1e-12);
      EXPECT_GT(p.weights[0], 0);
    }
}

/// A convex quadratic with axes turned at random and a condition number of 1e6, minimum inside the box.
class RotatedEllipsoid : public RowFunction {
 public:
  explicit RotatedEllipsoid(std::size_t n) : RowFunction(n) {
    RandomStream draws(root_key(99));
    const auto size = static_cast<Eigen::Index>(n);
    Eigen::MatrixXd random(size, size);
    for (Eigen::Index i = 0; i < size * size; ++i) random(i % size, i / size) = draws.normal();
    axes_ = Eigen::HouseholderQR<Eigen::MatrixXd>(random).householderQ();
  }
  double value(std::span<const double> x) const override {
    Eigen::VectorXd offset(axes_.rows());
    for (Eigen::Index i = 0; i < offset.size(); ++i)
      offset[i] = x[std::size_t(i)] - Sphere::centre(std::size_t(i));
    const Eigen::VectorXd along = axes_.transpose() * offset;
    double sum = 0;
    for (Eigen::Index i = 0; i < along.size(); ++i)
      sum += std::pow(1e6, double(i) / double(along.size() - 1)) * along[i] * along[i];
    return sum;
  }

 private:
  Eigen::MatrixXd axes_;
};

TEST(CmaEs, SolvesARotatedEllipsoidWithin7000Evaluations) {
  for (Seed seed = 1; seed <= 5; ++seed) {
    Observer silent;
    const RotatedEllipsoid ellipsoid(10);
    const auto result =
        optimizer_by_name("cma_es").minimize(ellipsoid, {}, Budget{7000, 1e-8}, {}, seed, silent);
    EXPECT_EQ(result.stopped_by, StopReason::target) << "seed " << seed << ": " << result.best_value;
  }
}

/// The sum of coordinates: the minimum is a corner.
class Corner : public RowFunction {
 public:
  using RowFunction::RowFunction;
  double value(std::span<const double> x) const override {
    double sum = 0;
    for (double coordinate : x) sum += coordinate;
    return sum;
  }
};

TEST(CmaEs, FindsAMinimumInACornerOfTheBox) {
  Observer silent;
  const auto result = optimizer_by_name("cma_es").minimize(Corner(10), {}, Budget{4000, 1e-4}, {}, 1, silent);
  EXPECT_EQ(result.stopped_by, StopReason::target) << result.best_value;
}

TEST(CmaEs, BeginsAtTheBestGivenStart) {
  Trace trace;
  std::vector<double> start(5, 0.9);
  for (std::size_t i = 0; i < 5; ++i) start.push_back(0.25);
  optimizer_by_name("cma_es").minimize(Sphere(5), {{"sigma0", 1e-3}}, Budget{10}, start, 1, trace);
  for (std::size_t i = 10; i < trace.points.size(); ++i) EXPECT_NEAR(trace.points[i], 0.25, 0.01);
}

TEST(CmaEs, RestartsWithADoubledPopulation) {
  Trace trace;
  optimizer_by_name("cma_es").minimize(Flat(2), {{"population", 6}}, Budget{2000}, {}, 1, trace);
  std::vector<std::size_t> sizes = trace.batch_sizes;
  sizes.pop_back();  // the last batch is cut
  EXPECT_TRUE(std::is_sorted(sizes.begin(), sizes.end()));
  EXPECT_NE(std::find(sizes.begin(), sizes.end(), 12), sizes.end());
  EXPECT_NE(std::find(sizes.begin(), sizes.end(), 24), sizes.end());
  EXPECT_EQ(sizes.front(), 6u);
}

TEST(CmaDistribution, SamplesFollowMeanAndCovariance) {
  Eigen::VectorXd mean(2);
  mean << 0.3, 0.7;
  CmaDistribution cma(mean, 0.1, 10);
  for (int generation = 0; generation < 60; ++generation) {  // a narrow valley along (1, 1)
    std::vector<Eigen::VectorXd> candidates;
    for (std::size_t i = 0; i < 10; ++i) {
      RandomStream draws = random_stream_at(root_key(1), std::uint64_t(generation), i);
      candidates.push_back(cma.sample(draws));
    }
    const auto cost = [](const Eigen::VectorXd& x) {
      return std::pow(x[0] - x[1], 2) + 1e-4 * x.squaredNorm();
    };
    std::sort(candidates.begin(), candidates.end(),
              [&](const auto& a, const auto& b) { return cost(a) < cost(b); });
    cma.update(candidates);
  }
  Eigen::MatrixXd moments = Eigen::MatrixXd::Zero(2, 2);
  constexpr int kCount = 50000;
  RandomStream draws(root_key(2));
  for (int i = 0; i < kCount; ++i) {
    const Eigen::VectorXd y = (cma.sample(draws) - cma.mean()) / cma.sigma();
    moments += y * y.transpose() / kCount;
  }
  Eigen::MatrixXd C = cma.covariance().selfadjointView<Eigen::Lower>();
  EXPECT_LT((moments - C).norm(), 0.1 * C.norm());  // C may be one lazy decomposition ahead
  EXPECT_GT(C(1, 0) / std::sqrt(C(0, 0) * C(1, 1)), 0.9);
}

}  // namespace
}  // namespace espalier
