// What the optimisers' minimize have in common: settings, dimension, budget and start points are checked,
// the start points evaluated, and StopSearch caught. A method itself is one function, search().
#pragma once
#include <span>
#include <vector>

#include <espalier/fitting/optimizers/evaluator.h>
#include <espalier/fitting/optimizers/optimizer.h>
#include <espalier/fitting/optimizers/random_stream.h>

namespace espalier {

/// A point of the unit box and its value.
struct RatedPoint {
  std::vector<double> point;
  double value = kWorstValue;
};

/// One run of a method.
struct Search {
  Evaluator& evaluator;
  const OptimizerSettings& settings;      ///< complete and checked: defaults where the caller gave none
  const std::vector<RatedPoint>& starts;  ///< the given start points, evaluated, best first; often empty
  RandomKey key;

  double setting(const char* name) const { return settings.at(name); }
  std::size_t count_setting(const char* name) const { return static_cast<std::size_t>(settings.at(name)); }
};

class SearchMethod : public Optimizer {
 public:
  MinimizeResult minimize(const Objective& objective, const OptimizerSettings& settings, const Budget& budget,
                          std::span<const double> start, Seed seed, Observer& observer) const final;

 private:
  /// Evaluates through run.evaluator until that throws StopSearch; returning means converged.
  virtual void search(Search& run) const = 0;
};

/// `given` over the defaults of `known`. Throws InputError for unknown names, values out of range, NaN, and
/// fractions where whole numbers are needed; `optimizer` opens the message.
OptimizerSettings complete_settings(const std::string& optimizer, std::span<const OptimizerSetting> known,
                                    const OptimizerSettings& given);

/// A uniformly random point of the unit box.
std::vector<double> random_point(std::size_t dimension, RandomStream& draws);

/// Folds any finite coordinate back into [0, 1] by mirroring at the bounds.
double reflect_into_unit(double coordinate);

/// The indices of `values` from the smallest to the largest; ties keep their order.
std::vector<std::size_t> ranked(std::span<const double> values);

}  // namespace espalier
