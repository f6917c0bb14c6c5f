// CMA-ES: strategy parameters, sampling, and the update of mean, step size, paths and covariance.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include <espalier/fitting/optimizers/cma_distribution.h>

namespace espalier {

namespace {

/// mu_eff of a run of raw weights (eq. 8, and the same for the negative ones).
double effective_count(const Eigen::VectorXd& weights) {
  return weights.sum() * weights.sum() / weights.squaredNorm();
}

/// The sum that the negative weights get (eqs 50-53).
double negative_weight_sum(const CmaParameters& p, double mu_eff_minus, double n) {
  const double alpha_mu = 1 + p.c_1 / p.c_mu;
  const double alpha_mu_eff = 1 + 2 * mu_eff_minus / (mu_eff_minus + 2);
  const double alpha_pos_def = (1 - p.c_1 - p.c_mu) / (n * p.c_mu);
  return std::min({alpha_mu, alpha_mu_eff, alpha_pos_def});
}

void set_rates(CmaParameters& p, double n) {
  constexpr double kAlphaCov = 2;
  p.c_sigma = (p.mu_eff + 2) / (n + p.mu_eff + 5);                                          // eq. 55
  p.d_sigma = 1 + 2 * std::max(0.0, std::sqrt((p.mu_eff - 1) / (n + 1)) - 1) + p.c_sigma;   // eq. 55
  p.c_c = (4 + p.mu_eff / n) / (n + 4 + 2 * p.mu_eff / n);                                  // eq. 56
  p.c_1 = kAlphaCov / ((n + 1.3) * (n + 1.3) + p.mu_eff);                                   // eq. 57
  const double selected = kAlphaCov * (0.25 + p.mu_eff + 1 / p.mu_eff - 2);                 // eq. 58
  p.c_mu = std::min(1 - p.c_1, selected / ((n + 2) * (n + 2) + kAlphaCov * p.mu_eff / 2));  // eq. 58
  p.chi_n = std::sqrt(n) * (1 - 1 / (4 * n) + 1 / (21 * n * n));                            // after eq. 44
}

}  // namespace

CmaParameters cma_parameters(std::size_t n, std::size_t lambda) {
  CmaParameters p;
  p.lambda = lambda;
  p.mu = lambda / 2;
  p.weights.resize(static_cast<Eigen::Index>(lambda));
  for (Eigen::Index i = 0; i < p.weights.size(); ++i)  // eq. 49
    p.weights[i] = std::log((static_cast<double>(lambda) + 1) / 2) - std::log(static_cast<double>(i) + 1);
  auto positive = p.weights.head(static_cast<Eigen::Index>(p.mu));
  auto negative = p.weights.tail(static_cast<Eigen::Index>(lambda - p.mu));
  p.mu_eff = effective_count(positive);
  const double mu_eff_minus = effective_count(negative);
  set_rates(p, static_cast<double>(n));
  positive /= positive.sum();  // eq. 53
  if (negative.sum() < 0)
    negative *= negative_weight_sum(p, mu_eff_minus, static_cast<double>(n)) / -negative.sum();
  return p;
}

std::size_t cma_population(std::size_t n) {
  return 4 + static_cast<std::size_t>(std::floor(3 * std::log(static_cast<double>(n))));
}

CmaDistribution::CmaDistribution(const Eigen::VectorXd& mean, double sigma, std::size_t lambda)
    : p_(cma_parameters(static_cast<std::size_t>(mean.size()), lambda)),
      mean_(mean),
      sigma_(sigma),
      p_sigma_(Eigen::VectorXd::Zero(mean.size())),
      p_c_(Eigen::VectorXd::Zero(mean.size())),
      C_(Eigen::MatrixXd::Identity(mean.size(), mean.size())),
      B_(Eigen::MatrixXd::Identity(mean.size(), mean.size())),
      D_(Eigen::VectorXd::Ones(mean.size())) {}

Eigen::VectorXd CmaDistribution::sample(RandomStream& draws) const {
  Eigen::VectorXd z(mean_.size());
  for (double& coordinate : z) coordinate = draws.normal();
  return mean_ + sigma_ * (B_ * D_.cwiseProduct(z));
}

void CmaDistribution::update(std::span<const Eigen::VectorXd> candidates) {
  ++generation_;
  std::vector<Eigen::VectorXd> y;
  for (const Eigen::VectorXd& x : candidates) y.push_back((x - mean_) / sigma_);
  Eigen::VectorXd y_w = Eigen::VectorXd::Zero(mean_.size());
  for (std::size_t i = 0; i < p_.mu; ++i) y_w += p_.weights[static_cast<Eigen::Index>(i)] * y[i];  // eq. 41
  mean_ += sigma_ * y_w;                                                                           // eq. 42
  update_paths(y_w);
  const bool h_sigma = path_is_short();
  p_c_ *= 1 - p_.c_c;  // eq. 45
  if (h_sigma) p_c_ += std::sqrt(p_.c_c * (2 - p_.c_c) * p_.mu_eff) * y_w;
  update_covariance(y, h_sigma);
  const double lazy = 1 / (10 * static_cast<double>(mean_.size()) * (p_.c_1 + p_.c_mu));  // section B.2
  if (static_cast<double>(generation_ - decomposed_at_) >= lazy) decompose();
}

void CmaDistribution::update_paths(const Eigen::VectorXd& y_w) {
  const double c = p_.c_sigma;
  p_sigma_ = (1 - c) * p_sigma_ + std::sqrt(c * (2 - c) * p_.mu_eff) * whitened(y_w);    // eq. 43
  sigma_ *= std::exp(std::min(1.0, c / p_.d_sigma * (p_sigma_.norm() / p_.chi_n - 1)));  // eq. 44
}

/// h_sigma of section A: false while the path is too long, which stalls the rank-one update.
bool CmaDistribution::path_is_short() const {
  const double n = static_cast<double>(mean_.size());
  const double started = 1 - std::pow(1 - p_.c_sigma, 2 * static_cast<double>(generation_));
  return p_sigma_.norm() / std::sqrt(started) < (1.4 + 2 / (n + 1)) * p_.chi_n;
}

void CmaDistribution::update_covariance(const std::vector<Eigen::VectorXd>& y, bool h_sigma) {
  const double delta = h_sigma ? 0 : p_.c_c * (2 - p_.c_c);
  C_ *= 1 + p_.c_1 * delta - p_.c_1 - p_.c_mu * p_.weights.sum();  // eq. 47
  const auto add = [&](double weight, const Eigen::VectorXd& v) {
    C_.selfadjointView<Eigen::Lower>().rankUpdate(v, weight);
  };
  add(p_.c_1, p_c_);
  for (std::size_t i = 0; i < y.size(); ++i) {
    double weight = p_.weights[static_cast<Eigen::Index>(i)];
    if (weight < 0)  // eq. 46
      weight *= static_cast<double>(mean_.size()) / std::max(whitened(y[i]).squaredNorm(), 1e-300);
    add(p_.c_mu * weight, y[i]);
  }
}

/// C^(-1/2) y, by the last decomposition.
Eigen::VectorXd CmaDistribution::whitened(const Eigen::VectorXd& y) const {
  const Eigen::VectorXd z = (B_.transpose() * y).cwiseQuotient(D_);
  return B_ * z;
}

void CmaDistribution::decompose() {
  decomposed_at_ = generation_;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(C_);  // reads the lower half
  B_ = solver.eigenvectors();
  D_ = solver.eigenvalues().cwiseSqrt();  // a negative eigenvalue becomes NaN: is_exhausted sees it
}

void CmaDistribution::limit_sigma(double limit) {
  const double longest = sigma_ * D_.maxCoeff();
  if (longest > limit) sigma_ *= limit / longest;
}

bool CmaDistribution::is_exhausted(double step) const {
  if (!D_.allFinite() || !(D_.minCoeff() > 0) || !std::isfinite(sigma_)) return true;
  const double condition = D_.maxCoeff() / D_.minCoeff();
  const double longest_step = sigma_ * std::sqrt(C_.diagonal().maxCoeff());
  return condition > 1e7 || (longest_step < step && sigma_ * p_c_.cwiseAbs().maxCoeff() < step);
}

}  // namespace espalier
