// How a picture was read, as a picture to look at: the picture, what of it is tree and what was left out, the
// mask that a fit sees, and its leaves and wood.
#pragma once
#include <espalier/image/pictures/decode.h>
#include <espalier/image/pictures/picture.h>
#include <espalier/image/reading/read_target.h>

namespace espalier {

inline constexpr Rgb kLeftOutColor{230, 120, 0}, kPaleTreeColor{0, 90, 40};

/// Four panels of the mask's size, side by side.
Picture target_sheet(const DecodedPicture& picture, const TargetPicture& target);

}  // namespace espalier
