// A leaf or blossom at a child site [CH §3.2.2].
#pragma once
#include "plant/plant.h"
#include "weber_penn/children.h"

namespace espalier {

/// Appends the leaf that grows at `site` of `stem`.
void place_leaf(const GrowingStem& stem, const ChildSite& site, const WeberPennParameters& parameters,
                Leaves& leaves);

/// Appends kind, length and width of leaf `index` of `stem`.
void append_leaf_size(const GrowingStem& stem, int index, float grown_fraction,
                      const WeberPennParameters& parameters, Leaves& leaves);

}  // namespace espalier
