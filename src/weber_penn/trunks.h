// Where the trunks of a tree stand and how they begin [CH §3.2.1 Multiple Trunks].
#pragma once
#include <vector>

#include <espalier/weber_penn/scalar/stem.h>

namespace espalier {

/// The scale of a whole tree, with its variation [Weber & Penn 95, §4.2]; of the key of its first trunk.
float tree_scale_m(const WeberPennParameters& parameters, RandomKey trunk);

/// Appends the trunks (branches[0] of them) to `stems`, ready to grow.
void plant_trunks(const WeberPennParameters& parameters, RandomKey root, std::vector<GrowingStem>& stems);

/// By its key and the scale of its tree.
float trunk_length_m(const GrowingStem& trunk, const WeberPennParameters& p);

}  // namespace espalier
