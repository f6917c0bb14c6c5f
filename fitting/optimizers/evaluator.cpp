// The counting, cutting, remembering and stopping that all optimisers share.
#include <algorithm>
#include <cmath>

#include <espalier/core/error.h>
#include <espalier/fitting/optimizers/evaluator.h>

namespace espalier {

Evaluator::Evaluator(const Objective& objective, const Budget& budget, Observer& observer)
    : objective_(objective),
      budget_(budget),
      observer_(observer),
      dimension_(objective.dimension()),
      best_value_(std::numeric_limits<double>::infinity()) {
  if (dimension_ == 0) throw_input_error("search space: got 0 free parameters, expected at least 1");
  if (budget.evaluations < 1)
    throw_input_error("budget: got {} evaluations, expected at least 1", budget.evaluations);
  if (std::isnan(budget.target)) throw_input_error("target value: got NaN, expected a number");
}

std::span<const double> Evaluator::evaluate(std::span<const double> points) {
  ESPALIER_CHECK_EQ(points.size() % dimension_, 0u);
  if (observer_.stop_requested()) throw StopSearch{StopReason::observer};
  const auto left = static_cast<std::size_t>(budget_.evaluations - evaluations_);
  const std::size_t count = std::min(points.size() / dimension_, left);
  points = points.first(count * dimension_);
  values_.resize(count);
  objective_.evaluate(points, values_);
  record(points);
  if (best_value_ <= budget_.target) throw StopSearch{StopReason::target};
  if (evaluations_ >= budget_.evaluations) throw StopSearch{StopReason::budget};
  return values_;
}

void Evaluator::record(std::span<const double> points) {
  for (std::size_t i = 0; i < values_.size(); ++i) {
    if (!std::isfinite(values_[i]) || values_[i] > kWorstValue) values_[i] = kWorstValue;
    if (values_[i] < best_value_) {  // ties: the first one stays
      best_value_ = values_[i];
      const auto row = points.subspan(i * dimension_, dimension_);
      best_point_.assign(row.begin(), row.end());
    }
  }
  const long first_evaluation = evaluations_;
  evaluations_ += static_cast<long>(values_.size());
  observer_.on_batch(first_evaluation, points, values_);
}

MinimizeResult Evaluator::result(StopReason reason) const {
  return {best_point_, best_value_, evaluations_, reason};
}

}  // namespace espalier
