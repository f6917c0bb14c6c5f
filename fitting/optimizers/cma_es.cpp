// CMA-ES with restarts in a box. Restarts double the population (IPOP: Auger, Hansen, CEC 2005).
// Box: a candidate beyond a bound is evaluated at its mirror image, while the update sees the candidate
// itself ("Darwinian reflection", Biedrzycki, Swarm and Evolutionary Computation 52, 2020): the
// strategy then searches an even, periodic continuation of the objective, and needs no penalty weights.
#include <algorithm>
#include <cmath>
#include <deque>

#include <espalier/fitting/optimizers/cma_distribution.h>
#include <espalier/fitting/optimizers/methods.h>
#include <espalier/fitting/optimizers/search_method.h>

namespace espalier {

namespace {

/// The best values of the last generations: no range left means nothing more to find here (section B.3).
class FlatHistory {
 public:
  FlatHistory(std::size_t n, std::size_t lambda) : length_(10 + (30 * n + lambda - 1) / lambda) {}

  void add(double best) {
    best_.push_back(best);
    if (best_.size() > length_) best_.pop_front();
  }

  /// TolFun, and with it EqualFunValues.
  bool is_flat(double tolerance, double generation_range) const {
    if (best_.size() < length_) return false;
    const auto [low, high] = std::minmax_element(best_.begin(), best_.end());
    return *high - *low <= tolerance && generation_range <= tolerance;
  }

 private:
  std::size_t length_;
  std::deque<double> best_;
};

/// The start points one after the other, then again; a random point where there are none.
Eigen::VectorXd first_mean(const Search& run, std::uint64_t restart) {
  RandomStream draws = random_stream_at(run.key, restart, 0);
  const std::vector<double> point = run.starts.empty() ? random_point(run.evaluator.dimension(), draws)
                                                       : run.starts[restart % run.starts.size()].point;
  return Eigen::Map<const Eigen::VectorXd>(point.data(), static_cast<Eigen::Index>(point.size()));
}

std::vector<Eigen::VectorXd> sample_all(const CmaDistribution& cma, std::size_t lambda, RandomKey key,
                                        std::uint64_t generation) {
  std::vector<Eigen::VectorXd> candidates;
  for (std::size_t i = 0; i < lambda; ++i) {
    RandomStream draws = random_stream_at(key, generation, i);
    candidates.push_back(cma.sample(draws));
  }
  return candidates;
}

std::span<const double> evaluate_mirrored(Search& run, const std::vector<Eigen::VectorXd>& candidates) {
  std::vector<double> points;
  for (const Eigen::VectorXd& candidate : candidates)
    for (double coordinate : candidate) points.push_back(reflect_into_unit(coordinate));
  return run.evaluator.evaluate(points);
}

std::vector<Eigen::VectorXd> in_order(const std::vector<Eigen::VectorXd>& candidates,
                                      std::span<const std::size_t> order) {
  std::vector<Eigen::VectorXd> sorted;
  for (std::size_t i : order) sorted.push_back(candidates[i]);
  return sorted;
}

/// A start point is worth staying near to: with 0.3, a fit's first samples are all worse than its preset, and
/// a minute is too short to come back (experiments/bundled_targets.md). Later rounds look twice as far
/// around.
double first_sigma(const Search& run, std::uint64_t restart) {
  if (const double given = run.setting("sigma0"); given > 0) return given;
  if (run.starts.empty()) return 0.3;
  const std::uint64_t round = restart / run.starts.size();
  return std::min(0.3, 0.05 * std::exp2(static_cast<double>(round)));
}

/// One strategy from its first mean until it has nothing left to find.
void run_strategy(Search& run, std::size_t lambda, std::uint64_t restart) {
  const RandomKey key = child_key(child_key(run.key, restart), 1);
  CmaDistribution cma(first_mean(run, restart), first_sigma(run, restart), lambda);
  FlatHistory history(run.evaluator.dimension(), lambda);
  for (std::uint64_t generation = 0; !cma.is_exhausted(run.setting("tol_x")); ++generation) {
    const auto candidates = sample_all(cma, lambda, key, generation);
    const auto values = evaluate_mirrored(run, candidates);
    const auto order = ranked(values);
    cma.update(in_order(candidates, order));
    cma.limit_sigma(1);  // the continuation repeats: longer steps find nothing new
    history.add(values[order.front()]);
    if (history.is_flat(run.setting("tol_fun"), values[order.back()] - values[order.front()])) return;
  }
}

class CmaEs final : public SearchMethod {
 public:
  std::string name() const override { return "cma_es"; }
  std::string help() const override {
    return "CMA-ES (Hansen, arXiv:1604.00772), mirrored at the bounds, restarts with growing population";
  }
  std::vector<OptimizerSetting> settings() const override {
    return {
        {"population", 0, 0, 65536, "candidates a generation; 0: 4 + floor(3 ln n); 1 counts as 2", true},
        {"sigma0", 0, 0, 1,
         "first standard deviation, as a share of the box; 0: 0.05 at a start point, else 0.3"},
        {"growth", 2, 1, 16, "factor on the population at each restart, up to 65536"},
        {"tol_x", 1e-11, 1e-15, 0.1, "standard deviation below which a restart follows"},
        {"tol_fun", 1e-12, 0, 1e6, "range of values below which a restart follows"},
    };
  }

 private:
  void search(Search& run) const override {
    const std::size_t given = run.count_setting("population");
    double lambda = static_cast<double>(given == 0 ? cma_population(run.evaluator.dimension()) : given);
    for (std::uint64_t restart = 0;; ++restart) {
      run_strategy(run, static_cast<std::size_t>(std::clamp(lambda, 2.0, 65536.0)), restart);
      lambda = std::min(lambda * run.setting("growth"), 65536.0);
    }
  }
};

}  // namespace

std::unique_ptr<Optimizer> make_cma_es() { return std::make_unique<CmaEs>(); }

}  // namespace espalier
