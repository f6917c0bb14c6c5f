// The one place through which every optimiser evaluates: counts true evaluations, cuts the last batch to
// the budget, remembers the best, calls the observer in order, and ends the run by throwing StopSearch,
// which SearchMethod::minimize catches.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include <espalier/fitting/optimizers/optimizer.h>

namespace espalier {

/// Values above this, and those that are not finite, count as this: finite, and worse than any fit.
inline constexpr double kWorstValue = 1e30;

/// Ends a search from inside. Not a std::exception: nothing but minimize should catch it.
struct StopSearch {
  StopReason reason;
};

class Evaluator {
 public:
  /// Throws InputError for a budget below 1, a target that is NaN, or an objective without dimensions.
  Evaluator(const Objective& objective, const Budget& budget, Observer& observer);

  const Objective& objective() const { return objective_; }
  std::size_t dimension() const { return dimension_; }
  long evaluations() const { return evaluations_; }

  /// points: rows of dimension() coordinates. Returns their values, valid until the next call.
  /// Throws StopSearch before the batch when the observer wants to stop, and after it (cut to what was left)
  /// when the target is reached or the budget used up: whoever gets values back got all of them.
  std::span<const double> evaluate(std::span<const double> points);

  MinimizeResult result(StopReason reason) const;

 private:
  void record(std::span<const double> points);

  const Objective& objective_;
  const Budget& budget_;
  Observer& observer_;
  std::size_t dimension_;
  long evaluations_ = 0;
  double best_value_;
  std::vector<double> best_point_;
  std::vector<double> values_;
};

}  // namespace espalier
