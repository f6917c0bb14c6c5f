// What a fit asks of a candidate: one number, 0 best. Scorers take parameter values, not points of a
// search space, so that presets are judged by the same measure as what the optimiser proposes.
#pragma once
#include <span>

#include <espalier/core/parameter_table.h>

namespace espalier {

class Scorer {
 public:
  virtual ~Scorer() = default;
  /// One finite score a candidate, in their order; score i depends on candidate i only.
  virtual void score(std::span<const ParameterValues> candidates, std::span<double> scores) = 0;
};

}  // namespace espalier
