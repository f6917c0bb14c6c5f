// What the stages of a fit hand on: one tree, by its parameters, its seed and the overrides of its branches.
#pragma once
#include "core/parameter_table.h"
#include "core/random.h"
#include "overrides/overrides.h"

namespace espalier {

struct Solution {
  ParameterValues values;
  Seed plant_seed = 1;
  Overrides overrides;
  double score = 1;  ///< dissimilarity, 0 is best
};

}  // namespace espalier
