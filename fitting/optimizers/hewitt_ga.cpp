// The dissertation's genetic algorithm (hewitt_ga.h). Its final choice, always to take the current best even
// where they are worse than the last generation's, is the default; elitist = 1 is its first variant.
#include <espalier/fitting/optimizers/hewitt_ga.h>
#include <espalier/fitting/optimizers/methods.h>
#include <espalier/fitting/optimizers/search_method.h>

namespace espalier {

namespace {

/// The coordinate of the negated parameter, or of the parameter itself where that sign is out of bounds.
double flip_sign(const Objective& objective, std::size_t index, double unit) {
  const double value = objective.value_of(index, unit);
  const double flipped = objective.unit_of(index, -value);
  return value * objective.value_of(index, flipped) < 0 ? flipped : unit;
}

double step_in_proportion(const Objective& objective, const HewittNumbers& numbers, RandomStream& draws,
                          std::size_t index, double unit) {
  const double value = objective.value_of(index, unit);
  const double share = draws.uniform_signed();
  if (value == 0) return std::clamp(unit + numbers.zero_step * share, 0.0, 1.0);
  return objective.unit_of(index, value * (1 + numbers.step * share));
}

}  // namespace

void permute_one_parameter(const Objective& objective, const HewittNumbers& numbers, RandomStream& draws,
                           std::span<double> point) {
  const std::size_t index = draws.below(point.size());
  double& unit = point[index];
  unit = step_in_proportion(objective, numbers, draws, index, unit);
  if (draws.chance(numbers.flip_chance)) unit = flip_sign(objective, index, unit);
}

std::vector<double> merge_parents(const Objective& objective, const HewittNumbers& numbers,
                                  RandomStream& draws, std::span<const double> fittest,
                                  std::span<const double> second) {
  std::vector<double> merged(fittest.begin(), fittest.end());
  for (std::size_t i = 0; i < merged.size(); ++i) {
    if (numbers.merge_mean) {
      const double sum = objective.value_of(i, fittest[i]) + objective.value_of(i, second[i]);
      if (fittest[i] != second[i]) merged[i] = objective.unit_of(i, sum / 2);
    } else if (draws.chance(0.5)) {
      merged[i] = second[i];
    }
  }
  return merged;
}

namespace {

HewittNumbers numbers_from(const Search& run) {
  return {run.count_setting("population"), run.setting("step"),         run.setting("flip_chance"),
          run.setting("zero_step"),        run.setting("elitist") != 0, run.setting("merge_mean") != 0};
}

/// `parent` copied, each copy with one parameter changed.
std::vector<double> permuted_copies(const Objective& objective, const HewittNumbers& numbers,
                                    std::span<const double> parent, RandomKey key, std::uint64_t generation) {
  std::vector<double> points;
  for (std::size_t i = 0; i < numbers.population; ++i) {
    RandomStream draws = random_stream_at(key, generation, i);
    points.insert(points.end(), parent.begin(), parent.end());
    permute_one_parameter(objective, numbers, draws, std::span(points).last(parent.size()));
  }
  return points;
}

class HewittGa final : public SearchMethod {
 public:
  std::string name() const override { return "hewitt_ga"; }
  std::string help() const override {
    return "the genetic algorithm of Hewitt's dissertation (2017), section 3.3.2";
  }
  std::vector<OptimizerSetting> settings() const override {
    const HewittNumbers numbers;
    return {
        {"population", static_cast<double>(numbers.population), 2, 65536, "children a generation", true},
        {"step", numbers.step, 0, 10, "largest change of a parameter, as a share of its value"},
        {"flip_chance", numbers.flip_chance, 0, 1, "chance that a child's changed parameter flips its sign"},
        {"zero_step", numbers.zero_step, 0, 1,
         "largest change of a parameter that is 0, as a share of its range; 0 leaves it there"},
        {"elitist", 0, 0, 1, "1: new parents only where they improve on the last generation", true},
        {"merge_mean", 0, 0, 1, "0: each parameter of the merged parent is either one's; 1: their mean",
         true},
    };
  }

 private:
  void search(Search& run) const override {
    const Objective& objective = run.evaluator.objective();
    const HewittNumbers numbers = numbers_from(run);
    const std::size_t dimension = run.evaluator.dimension();
    RandomStream first_draws = random_stream_at(run.key, 0, 0);
    std::vector<double> parent =
        run.starts.empty() ? random_point(dimension, first_draws) : run.starts[0].point;
    double accepted = run.starts.empty() ? kWorstValue : run.starts[0].value;
    for (std::uint64_t generation = 1;; ++generation) {
      const auto points = permuted_copies(objective, numbers, parent, run.key, generation);
      const auto values = run.evaluator.evaluate(points);
      const auto order = ranked(values);
      if (numbers.elitist && values[order[0]] >= accepted) continue;
      accepted = values[order[0]];
      RandomStream draws = random_stream_at(run.key, generation, numbers.population);
      const auto row = [&](std::size_t i) { return std::span(points).subspan(i * dimension, dimension); };
      parent = merge_parents(objective, numbers, draws, row(order[0]), row(order[1]));
    }
  }
};

}  // namespace

std::unique_ptr<Optimizer> make_hewitt_ga() { return std::make_unique<HewittGa>(); }

}  // namespace espalier
