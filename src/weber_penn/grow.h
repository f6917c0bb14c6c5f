// Growing a whole tree, level by level [CH §3.2].
#pragma once
#include "plant/model.h"
#include "weber_penn/parameters.h"

namespace espalier {

/// Grows into `plant`. Stops, and reports by how much, where stems or leaves exceed the budget.
GrowthResult grow_tree(const WeberPennParameters& parameters, Seed seed, const GrowthSettings& settings,
                       Plant& plant);

}  // namespace espalier
