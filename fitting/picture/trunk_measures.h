// Stage 1 of a fit: how wide the trunk is and how far up it is bare, from the rows of a mask.
#pragma once
#include <espalier/image/masks/mask.h>
#include <espalier/image/masks/mask_box.h>

namespace espalier {

struct TrunkMeasures {
  int width_px = 1;       ///< where it is narrowest near the foot, or above what it stands on
  int bare_px = 0;        ///< from the foot up, until the outline becomes wider than a trunk
  int foot_width_px = 0;  ///< of the lowest row, where the trunk flares, or of its roots
  int stand_px = 0;       ///< rows of what the trunk stands on: a mound, a pot; 0 for the ground
  int stems = 0;          ///< runs of pixels a little above the foot
};

/// Measures a mask that is set in `box` and nowhere else.
TrunkMeasures measure_trunk(const Mask& mask, const MaskBox& box);

}  // namespace espalier
