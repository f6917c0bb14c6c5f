// Random search: independent uniform points. The floor that every other method has to beat.
#include <espalier/fitting/optimizers/methods.h>
#include <espalier/fitting/optimizers/search_method.h>

namespace espalier {

namespace {

class RandomSearch final : public SearchMethod {
 public:
  std::string name() const override { return "random_search"; }
  std::string help() const override { return "independent uniform points, the floor to beat"; }
  std::vector<OptimizerSetting> settings() const override {
    return {{"batch", 64, 1, 65536, "points evaluated together", true}};
  }

 private:
  void search(Search& run) const override {
    const std::size_t dimension = run.evaluator.dimension();
    std::vector<double> points(run.count_setting("batch") * dimension);
    for (std::uint64_t index = 0;;) {
      for (std::size_t begin = 0; begin < points.size(); begin += dimension) {
        RandomStream draws(child_key(run.key, index++));  // by point: the batch size changes nothing
        for (std::size_t i = 0; i < dimension; ++i) points[begin + i] = draws.uniform();
      }
      run.evaluator.evaluate(points);
    }
  }
};

}  // namespace

std::unique_ptr<Optimizer> make_random_search() { return std::make_unique<RandomSearch>(); }

}  // namespace espalier
