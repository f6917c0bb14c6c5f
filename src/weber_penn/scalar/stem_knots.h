// The knots of a stem: segment ends, or a finer resampling where the radius needs it [CH §3.2.1 Branch
// Radius].
#pragma once
#include <espalier/plant/plant.h>
#include <espalier/weber_penn/scalar/stem_walk.h>

namespace espalier {

/// Appends the knots of one segment; the first segment of a stem brings its start as well.
void append_knots(const GrowingStem& stem, const Segment& segment, const WeberPennParameters& parameters,
                  Knots& knots);

}  // namespace espalier
