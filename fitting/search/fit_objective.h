// The function an optimiser minimises: a point of the unit box becomes parameter values, and those a score.
#pragma once
#include <espalier/fitting/optimizers/optimizer.h>
#include <espalier/fitting/record/search_space.h>
#include <espalier/fitting/task/scorer.h>

namespace espalier {

class FitObjective : public Objective {
 public:
  /// Both must outlive the objective.
  FitObjective(const SearchSpace& space, Scorer& scorer) : space_(space), scorer_(scorer) {}
  std::size_t dimension() const override { return space_.dimension(); }
  void evaluate(std::span<const double> points, std::span<double> values) const override;
  double value_of(std::size_t index, double unit) const override {
    return value_at(space_.free[index], unit);
  }
  double unit_of(std::size_t index, double value) const override {
    return unit_at(space_.free[index], value);
  }

 private:
  const SearchSpace& space_;
  Scorer& scorer_;
};

}  // namespace espalier
