// The tree as what differs from the ground that the border shows, cut where it covers half of a pixel.
#pragma once
#include <espalier/image/separation/border_colors.h>
#include <espalier/image/separation/separation.h>

namespace espalier {

/// `shown`: the part of the picture that counts.
Separation separate_by_ground(const DecodedPicture& picture, const Mask& shown, const BorderColors& border,
                              const SeparationOptions& options);

}  // namespace espalier
