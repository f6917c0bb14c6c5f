// A leaf or blossom at a child site [CH §3.2.2].
#pragma once
#include <espalier/plant/plant.h>
#include <espalier/weber_penn/scalar/children.h>

namespace espalier {

/// Appends the leaf that grows at `site` of `stem`.
void place_leaf(const GrowingStem& stem, const ChildSite& site, const WeberPennParameters& parameters,
                Leaves& leaves);

/// Whether child `index` of `stem` is a leaf or a blossom.
LeafKind leaf_kind(const GrowingStem& stem, int index, const WeberPennParameters& parameters);

/// Factor on leaf_scale and blossom_scale, but for that of leaf_scale_along.
float leaf_growth(const GrowingStem& stem, float grown_fraction, const WeberPennParameters& parameters);

}  // namespace espalier
