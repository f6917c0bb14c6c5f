// Stage 1 of a fit, of palms: the line of the bare trunk, from its foot to the middle of the crown, and its
// widths.
#pragma once
#include <optional>
#include <vector>

#include <espalier/image/masks/mask.h>
#include <espalier/image/reading/medial_axes.h>

namespace espalier {

struct TrunkLine {
  std::vector<PixelPoint> points;             ///< from the foot up, at least two
  float foot_width_px = 0, top_width_px = 0;  ///< medians of its lowest and of its highest bare fifth

  float length_px() const;
};

/// Follows the trunk row by row from the foot up to where it meets the crown, then goes straight to the
/// middle of the largest disc that fits into the crown: where fronds spring from. Nothing where the mask
/// shows no bare trunk.
std::optional<TrunkLine> read_trunk_line(const Mask& mask);

}  // namespace espalier
