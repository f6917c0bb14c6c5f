// A fit with an optimiser of your own: a climber that tries eight steps at a time and shortens them when none
// leads up. SearchMethod checks settings, counts evaluations and stops; what is left is one function.
//   own_optimizer tree.png runs/climbed 300
#include <fmt/core.h>

#include <algorithm>
#include <string>

#include <espalier/espalier.h>

using namespace espalier;

namespace {

class Climber : public SearchMethod {
 public:
  std::string name() const override { return "climber"; }
  std::string help() const override { return "steps in random directions, ever shorter ones"; }
  std::vector<OptimizerSetting> settings() const override {
    return {{"step", 0.2, 0.001, 1, "the first step, as a share of each parameter's range"}};
  }

 private:
  /// All parameters are coordinates in [0, 1]. Evaluating ends the search by itself when the budget is used
  /// up.
  void search(Search& run) const override {
    RandomStream draws(run.key);  // from the seed: the run repeats bit for bit
    RatedPoint best{random_point(run.evaluator.dimension(), draws)};
    if (!run.starts.empty()) best = run.starts.front();
    for (double step = run.setting("step"); step > 1e-4;) {
      const std::vector<double> tried = neighbours(best.point, step, draws);
      const auto values = run.evaluator.evaluate(tried);  // eight at once, in parallel
      const auto lowest = std::min_element(values.begin(), values.end());
      if (*lowest < best.value) {
        const auto row = tried.begin() + (lowest - values.begin()) * static_cast<long>(best.point.size());
        best = {{row, row + static_cast<long>(best.point.size())}, *lowest};
      } else {
        step *= 0.8;
      }
    }
  }

  static std::vector<double> neighbours(const std::vector<double>& point, double step, RandomStream& draws) {
    std::vector<double> rows;
    for (int i = 0; i < 8; ++i)
      for (const double coordinate : point)
        rows.push_back(reflect_into_unit(coordinate + step * draws.uniform_signed()));
    return rows;
  }
};

}  // namespace

int main(int count, char** arguments) {
  if (count != 4) return fmt::print(stderr, "usage: own_optimizer PICTURE DIRECTORY EVALUATIONS\n"), 2;
  try {
    FitRecord record;
    record.views = {{arguments[1], {}}};
    record.budget = {.evaluations = std::stol(arguments[3]), .seconds = 0};
    record.optimizer_settings = {{"step", 0.1}};
    const Climber climber;
    FitExecution options;
    options.optimizer = &climber;
    const FitResult result = fit(record, arguments[2], options);
    fmt::print("fitness {:.3f}, {} evaluations, stopped by {}\n", result.fitness, result.evaluations,
               name_of(result.stopped_by));
  } catch (const InputError& error) {
    return fmt::print(stderr, "{}\n", error.what()), 2;
  }
}
