// How a taper is written for blends and species spaces: its values mean something else from one range to the
// next, though they run on [CH, Appendix C]. Under 1 it is the share by which a stem narrows; from 1 to 2 the
// stem narrows less and ends round; from 2 on it swells.
#pragma once
#include <espalier/core/parameter_codec.h>

namespace espalier {

/// How much the stem narrows, how much it swells, and whether it ends round.
const ParameterCodec& taper_codec();

}  // namespace espalier
