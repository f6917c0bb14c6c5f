// The state of the CMA evolution strategy and its update, after N. Hansen, "The CMA Evolution Strategy: A
// Tutorial", arXiv:1604.00772v2 (2023); equation numbers are that paper's, names its symbols.
// Knows neither bounds nor budgets. Matrix products avoid Eigen's parallel kernels (same bits, any threads).
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include <espalier/fitting/optimizers/random_stream.h>

namespace espalier {

/// Strategy parameters for dimension n and population lambda: table 1.
struct CmaParameters {
  std::size_t lambda = 0, mu = 0;
  Eigen::VectorXd weights;  ///< lambda of them, the worse half negative (active CMA)
  double mu_eff = 0;
  double c_sigma = 0, d_sigma = 0, c_c = 0, c_1 = 0, c_mu = 0;
  double chi_n = 0;  ///< the expected length of a standard normal vector
};

CmaParameters cma_parameters(std::size_t n, std::size_t lambda);

/// The default population, 4 + floor(3 ln n) (eq. 48).
std::size_t cma_population(std::size_t n);

class CmaDistribution {
 public:
  CmaDistribution(const Eigen::VectorXd& mean, double sigma, std::size_t lambda);

  /// A candidate: mean + sigma * B D z (eqs 38-40).
  Eigen::VectorXd sample(RandomStream& draws) const;

  /// candidates: the lambda sampled ones, best first. Updates all state (eqs 41-47).
  void update(std::span<const Eigen::VectorXd> candidates);

  /// Keeps the longest standard deviation at or below `limit`.
  void limit_sigma(double limit);

  const Eigen::VectorXd& mean() const { return mean_; }
  double sigma() const { return sigma_; }
  const Eigen::MatrixXd& covariance() const { return C_; }

  /// True where steps in all coordinates are below `step` (TolX), or C is ill-conditioned (ConditionCov), or
  /// its eigenvalues are no longer positive numbers: section B.3.
  bool is_exhausted(double step) const;

 private:
  void update_paths(const Eigen::VectorXd& y_w);
  void update_covariance(const std::vector<Eigen::VectorXd>& y, bool h_sigma);
  void decompose();
  Eigen::VectorXd whitened(const Eigen::VectorXd& y) const;
  bool path_is_short() const;

  CmaParameters p_;
  Eigen::VectorXd mean_;
  double sigma_;
  Eigen::VectorXd p_sigma_, p_c_;
  Eigen::MatrixXd C_, B_;
  Eigen::VectorXd D_;  ///< square roots of the eigenvalues of C
  long generation_ = 0, decomposed_at_ = 0;
};

}  // namespace espalier
