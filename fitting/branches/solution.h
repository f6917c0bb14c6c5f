// What the stages of a fit hand on: one tree, by its parameters, its seed and the overrides of its branches.
#pragma once
#include <espalier/core/parameter_table.h>
#include <espalier/core/random.h>
#include <espalier/overrides/overrides.h>

namespace espalier {

struct Solution {
  ParameterValues values;
  Seed plant_seed = 1;
  Overrides overrides;
  double score = 1;  ///< dissimilarity, 0 is best; once branches are refined, with the price of their numbers
};

}  // namespace espalier
