// Each term of the update of CMA-ES against the tutorial (N. Hansen, arXiv:1604.00772v2, 2023; equation
// numbers are its own). The equations are written down here a second time, as plainly as they stand there,
// and follow the same candidates: a term that is left out or fed with something else shows in the state.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include <espalier/fitting/optimizers/cma_distribution.h>

namespace espalier {
namespace {

using Candidates = std::vector<Eigen::VectorXd>;

/// Table 1, from the raw weights on.
struct Table1 {
  std::vector<double> w;
  double mu_eff = 0, c_sigma = 0, d_sigma = 0, c_c = 0, c_1 = 0, c_mu = 0;

  Table1(double n, std::size_t lambda) : w(lambda) {
    const std::size_t mu = lambda / 2;
    double plus = 0, plus_squares = 0, minus = 0, minus_squares = 0;
    for (std::size_t i = 0; i < lambda; ++i) {
      w[i] = std::log((double(lambda) + 1) / 2) - std::log(double(i + 1));  // eq. 49
      (i < mu ? plus : minus) += w[i];
      (i < mu ? plus_squares : minus_squares) += w[i] * w[i];
    }
    mu_eff = plus * plus / plus_squares;
    c_sigma = (mu_eff + 2) / (n + mu_eff + 5);
    d_sigma = 1 + 2 * std::max(0.0, std::sqrt((mu_eff - 1) / (n + 1)) - 1) + c_sigma;
    c_c = (4 + mu_eff / n) / (n + 4 + 2 * mu_eff / n);
    c_1 = 2 / ((n + 1.3) * (n + 1.3) + mu_eff);
    c_mu = std::min(1 - c_1, 2 * (0.25 + mu_eff + 1 / mu_eff - 2) / ((n + 2) * (n + 2) + mu_eff));
    const double mu_eff_minus = minus * minus / minus_squares;
    const double least = std::min({1 + c_1 / c_mu, 1 + 2 * mu_eff_minus / (mu_eff_minus + 2),
                                   (1 - c_1 - c_mu) / (n * c_mu)});              // eqs 50-52
    for (double& weight : w) weight *= weight >= 0 ? 1 / plus : least / -minus;  // eq. 53
  }
};

/// The state, and eqs 41-47 as they stand in appendix A.
struct Tutorial {
  Table1 p;
  double n, sigma;
  Eigen::VectorXd m, p_sigma, p_c;
  Eigen::MatrixXd C;
  int g = 0;
  bool h_sigma = true;

  Tutorial(const Eigen::VectorXd& mean, double first_sigma, std::size_t lambda)
      : p(double(mean.size()), lambda),
        n(double(mean.size())),
        sigma(first_sigma),
        m(mean),
        p_sigma(Eigen::VectorXd::Zero(mean.size())),
        p_c(p_sigma),
        C(Eigen::MatrixXd::Identity(mean.size(), mean.size())) {}

  void update(const Candidates& x) {
    const Eigen::MatrixXd whiten = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(C).operatorInverseSqrt();
    const double chi_n = std::sqrt(n) * (1 - 1 / (4 * n) + 1 / (21 * n * n));
    const double past = 2.0 * ++g;
    Candidates y;
    Eigen::VectorXd y_w = Eigen::VectorXd::Zero(m.size());
    for (const Eigen::VectorXd& candidate : x) y.push_back((candidate - m) / sigma);
    for (std::size_t i = 0; i < x.size() / 2; ++i) y_w += p.w[i] * y[i];                     // 41
    m += sigma * y_w;                                                                        // 42
    p_sigma *= 1 - p.c_sigma;                                                                // 43
    p_sigma += std::sqrt(p.c_sigma * (2 - p.c_sigma) * p.mu_eff) * (whiten * y_w);           // 43
    sigma *= std::exp(std::min(1.0, p.c_sigma / p.d_sigma * (p_sigma.norm() / chi_n - 1)));  // 44
    h_sigma = p_sigma.norm() / std::sqrt(1 - std::pow(1 - p.c_sigma, past)) < (1.4 + 2 / (n + 1)) * chi_n;
    p_c = (1 - p.c_c) * p_c + (h_sigma ? std::sqrt(p.c_c * (2 - p.c_c) * p.mu_eff) : 0) * y_w;  // 45
    const double delta = h_sigma ? 0 : p.c_c * (2 - p.c_c);
    double sum = 0;
    Eigen::MatrixXd rank_mu = Eigen::MatrixXd::Zero(C.rows(), C.cols());
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double scale = p.w[i] >= 0 ? 1 : n / (whiten * y[i]).squaredNorm();  // 46
      rank_mu += p.w[i] * scale * y[i] * y[i].transpose();
      sum += p.w[i];
    }
    C = (1 + p.c_1 * delta - p.c_1 - p.c_mu * sum) * C + p.c_1 * p_c * p_c.transpose() +
        p.c_mu * rank_mu;  // 47
  }
};

Eigen::MatrixXd whole(const Eigen::MatrixXd& lower_half) {
  return lower_half.selfadjointView<Eigen::Lower>();
}

/// Both see the same candidates, sampled by the distribution and sorted by `cost`; how often h_sigma was
/// false.
int follow(double (*cost)(const Eigen::VectorXd&), std::size_t lambda, int generations) {
  const Eigen::VectorXd mean = Eigen::VectorXd::LinSpaced(4, 0.2, 0.8);
  CmaDistribution cma(mean, 0.3, lambda);
  Tutorial tutorial(mean, 0.3, lambda);
  int stalled = 0;
  for (int generation = 0; generation < generations; ++generation) {
    Candidates candidates;
    for (std::size_t i = 0; i < lambda; ++i) {
      RandomStream draws = random_stream_at(root_key(7), std::uint64_t(generation), i);
      candidates.push_back(cma.sample(draws));
    }
    std::sort(candidates.begin(), candidates.end(),
              [&](const auto& a, const auto& b) { return cost(a) < cost(b); });
    cma.update(candidates);
    tutorial.update(candidates);
    stalled += !tutorial.h_sigma;
    EXPECT_LT((cma.mean() - tutorial.m).norm(), 1e-9 * tutorial.sigma) << "mean, " << generation;
    EXPECT_NEAR(cma.sigma() / tutorial.sigma, 1, 1e-9) << "sigma, " << generation;
    EXPECT_LT((whole(cma.covariance()) - tutorial.C).norm(), 1e-9 * tutorial.C.norm()) << "C, " << generation;
    if (testing::Test::HasFailure()) return stalled;
  }
  return stalled;
}

TEST(CmaParameters, WeightsAndRatesAreThoseOfTable1ForAnySize) {
  for (std::size_t n : {2u, 4u, 10u, 60u})
    for (std::size_t lambda : {4u, 9u, 40u, 200u}) {
      const CmaParameters p = cma_parameters(n, lambda);
      const Table1 expected(double(n), lambda);
      SCOPED_TRACE("n " + std::to_string(n) + ", lambda " + std::to_string(lambda));
      for (std::size_t i = 0; i < lambda; ++i) EXPECT_NEAR(p.weights[long(i)], expected.w[i], 1e-12) << i;
      EXPECT_NEAR(p.mu_eff, expected.mu_eff, 1e-9);
      EXPECT_NEAR(p.c_sigma, expected.c_sigma, 1e-12);
      EXPECT_NEAR(p.d_sigma, expected.d_sigma, 1e-12);
      EXPECT_NEAR(p.c_c, expected.c_c, 1e-12);
      EXPECT_NEAR(p.c_1, expected.c_1, 1e-12);
      EXPECT_NEAR(p.c_mu, expected.c_mu, 1e-12);
    }
}

TEST(CmaDistribution, FollowsTheTutorialOnAnEllipsoid) {
  const auto ellipsoid = [](const Eigen::VectorXd& x) {
    return x[0] * x[0] + 10 * std::pow(x[1] - x[2], 2) + 100 * x[2] * x[2] + 1000 * x[3] * x[3];
  };
  for (std::size_t lambda : {4u, 8u, 15u}) follow(ellipsoid, lambda, 60);
}

/// On a slope the path grows until h_sigma stalls the rank-one update.
TEST(CmaDistribution, FollowsTheTutorialOnASlopeWhereTheRankOneUpdateStalls) {
  const auto slope = [](const Eigen::VectorXd& x) { return x.sum(); };
  const int stalled = follow(slope, 8, 20);
  EXPECT_GT(stalled, 0);
  EXPECT_LT(stalled, 20);
}

constexpr Eigen::Index kParameters = 6;
constexpr std::size_t kCandidates = 9;

/// Nine candidates: the better four all at `step` from the mean, the others each along an axis, but the
/// first.
Candidates at_step(const CmaDistribution& cma, const Eigen::VectorXd& step) {
  Candidates candidates(4, cma.mean() + cma.sigma() * step);
  for (Eigen::Index axis = 1; axis < kParameters; ++axis)
    candidates.push_back(cma.mean() + cma.sigma() * Eigen::VectorXd::Unit(kParameters, axis));
  return candidates;
}

CmaDistribution at_origin() { return {Eigen::VectorXd::Zero(kParameters), 1, kCandidates}; }

/// To the rank-mu update y and -y are the same; the path tells a way that is kept from one that turns back.
TEST(CmaDistribution, TheRankOnePathLengthensTheDirectionThatIsKept) {
  CmaDistribution keeps = at_origin(), turns = at_origin();
  const Eigen::VectorXd step = Eigen::VectorXd::Unit(kParameters, 0);
  for (int generation = 0; generation < 4; ++generation) {
    keeps.update(at_step(keeps, step));
    turns.update(at_step(turns, generation % 2 == 0 ? step : -step));
  }
  EXPECT_GT(keeps.covariance()(0, 0), 1.2 * turns.covariance()(0, 0));
}

TEST(CmaDistribution, TheStepGrowsWhereThePathIsLongerThanChanceAndShrinksWhereItIsShorter) {
  CmaDistribution walks = at_origin(), rests = at_origin();
  for (int generation = 0; generation < 5; ++generation) {
    walks.update(at_step(walks, Eigen::VectorXd::Ones(kParameters)));
    rests.update(at_step(rests, 1e-3 * Eigen::VectorXd::Ones(kParameters)));
  }
  EXPECT_GT(walks.sigma(), 1.5);
  EXPECT_LT(rests.sigma(), 0.7);
}

TEST(CmaDistribution, ALimitedStepIsNoLongerThanTheLimitAndKeepsItsShape) {
  CmaDistribution cma = at_origin();
  for (int generation = 0; generation < 4; ++generation)
    cma.update(at_step(cma, Eigen::VectorXd::Unit(kParameters, 0)));
  const Eigen::MatrixXd before = cma.covariance();
  const double longest = std::sqrt(before(0, 0));
  cma.limit_sigma(0.25);
  EXPECT_NEAR(cma.sigma() * longest, 0.25, 1e-9);
  EXPECT_EQ(cma.covariance(), before);
  cma.limit_sigma(0.5);
  EXPECT_NEAR(cma.sigma() * longest, 0.25, 1e-9);
}

TEST(CmaDistribution, IsExhaustedWhereAllItsStepsAreBelowTheGivenOne) {
  const CmaDistribution cma(Eigen::VectorXd::Zero(3), 1e-3, 6);
  EXPECT_TRUE(cma.is_exhausted(1.1e-3));
  EXPECT_FALSE(cma.is_exhausted(0.9e-3));
}

}  // namespace
}  // namespace espalier
