// The memory that the plants of a fit may take, before any of them is grown.
#pragma once
#include <espalier/plant/model.h>

namespace espalier {

/// An upper bound, in bytes, of plants that use all of `budget`, one on each thread (at least 1).
double growth_memory_bytes(const GrowthBudget& budget, int threads);

/// Throws FieldError ("growth.max_stems", or max_leaves where these need more) where `budget` may need more
/// than `available_bytes`.
void check_growth_memory(const GrowthBudget& budget, int threads, double available_bytes);

}  // namespace espalier
