// The table of docs/optimizers.md: the median over 9 seeds of the best value after 2,000 evaluations, for
// each optimiser and three functions in 10 dimensions, without a start point. One line each:
//   build/bin/bench_optimizer_table --benchmark_counters_tabular=true
// The functions, on the unit box: sphere of distance to the minimum; Rosenbrock on [-2, 2]^n; Rastrigin on
// +-5.12 around the minimum. Minima off the grids that DIRECT divides by: coordinate i of the first and last
// is 0.3 + 0.4 frac((i + 1) g), g the golden ratio.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <espalier/fitting/optimizers/optimizer.h>

namespace espalier {
namespace {

using Function = double (*)(std::span<const double>);

double offset(std::span<const double> x, std::size_t i) {
  return x[i] - (0.3 + 0.4 * std::fmod((std::numbers::phi - 1) * static_cast<double>(i + 1), 1.0));
}

double sphere(std::span<const double> x) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += offset(x, i) * offset(x, i);
  return sum;
}

double rosenbrock(std::span<const double> x) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const double a = 4 * x[i] - 2, b = 4 * x[i + 1] - 2;
    sum += 100 * (b - a * a) * (b - a * a) + (1 - a) * (1 - a);
  }
  return sum;
}

double rastrigin(std::span<const double> x) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double a = 10.24 * offset(x, i);
    sum += a * a - 10 * std::cos(2 * std::numbers::pi * a) + 10;
  }
  return sum;
}

class Problem final : public Objective {
 public:
  explicit Problem(Function function) : function_(function) {}
  std::size_t dimension() const override { return 10; }
  void evaluate(std::span<const double> points, std::span<double> values) const override {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = function_(points.subspan(i * 10, 10));
  }

 private:
  Function function_;
};

double median_best(const Optimizer& optimizer, Function function) {
  std::vector<double> best;
  for (Seed seed = 1; seed <= 9; ++seed) {
    Observer silent;
    best.push_back(optimizer.minimize(Problem(function), {}, Budget{2000}, {}, seed, silent).best_value);
  }
  std::nth_element(best.begin(), best.begin() + 4, best.end());
  return best[4];
}

void tabulate(benchmark::State& state, const Optimizer& optimizer) {
  for (auto _ : state) {
    state.counters["sphere"] = median_best(optimizer, sphere);
    state.counters["rosenbrock"] = median_best(optimizer, rosenbrock);
    state.counters["rastrigin"] = median_best(optimizer, rastrigin);
  }
}

const bool kRegistered = [] {
  for (const auto& optimizer : all_optimizers())
    benchmark::RegisterBenchmark(optimizer->name().c_str(), [&optimizer](benchmark::State& state) {
      tabulate(state, *optimizer);
    })->Iterations(1);
  return true;
}();

}  // namespace
}  // namespace espalier
