// How long a silhouette's pieces and gaps are in four directions: level, upright, and slanted up away from
// the trunk or up towards it. Leaves leave short runs, branches leave long ones along themselves. Soille,
// Morphological Image Analysis (2003), section 4.3: openings by segments.
#pragma once
#include <string>
#include <vector>

#include <espalier/image/masks/mask.h>
#include <espalier/image/masks/mask_box.h>

namespace espalier {

/// Pixels that lie on a straight run of `length_px` set ones or more; the next pixel of a run is dx to the
/// right of the last and dy below it, each -1, 0 or 1.
Mask on_runs(const Mask& mask, int length_px, int dx, int dy);

/// Appends, for pieces and for gaps between a row's ends, for each direction, length and tier of the box, the
/// share of the pixels between the rows' ends that lie on such runs. `mask`: kSummaryFramePx wide.
void add_oriented_runs(const Mask& mask, const MaskBox& box, std::vector<double>& summaries);
void name_oriented_runs(std::vector<std::string>& names);

}  // namespace espalier
