// How large a tree will get, from its parameters alone: candidates beyond the budget are refused unseen.
#pragma once
#include <espalier/plant/model.h>
#include <espalier/weber_penn/table/parameters.h>

namespace espalier {

/// Expected stems and leaves, without pruning; within a factor of about two of what grows.
GrowthEstimate estimate_growth(const WeberPennParameters& parameters);

}  // namespace espalier
