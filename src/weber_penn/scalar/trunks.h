// Where the trunks of a tree stand and how they begin [CH §3.2.1 Multiple Trunks].
#pragma once
#include <vector>

#include <espalier/weber_penn/scalar/stem.h>

namespace espalier {

/// Appends the trunks (branches[0] of them) to `stems`, ready to grow.
void plant_trunks(const WeberPennParameters& parameters, RandomKey root, std::vector<GrowingStem>& stems);

}  // namespace espalier
