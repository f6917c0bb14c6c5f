// Helical stems, where curve_v is negative [CH §3.2.1 Helical Branches].
#pragma once
#include <espalier/weber_penn/scalar/stem_walk.h>

namespace espalier {

/// Like walk_stem, for a stem that winds about its first heading; helices do not split.
void walk_helix(const GrowingStem& stem, const WeberPennParameters& parameters, StemVisitor& visitor);

}  // namespace espalier
