// Morphology of masks, a word of 64 pixels at a time. The world ends at the border of the picture:
// a structuring element is cut there, so closing is extensive and idempotent on the whole picture.
// Serra, Image Analysis and Mathematical Morphology (1982).
#pragma once
#include <espalier/image/masks/mask.h>

namespace espalier {

/// One step of the city-block distance into `result`, another mask, which keeps its memory: each set pixel
/// and its 4 neighbours.
void dilate_plus(const Mask& mask, Mask& result);

/// One step of the chessboard distance, likewise: each set pixel and its 8 neighbours.
void dilate_square(const Mask& mask, Mask& result);

/// All pixels within `radius_px` (Euclidean, centre to centre) of a set one.
Mask dilate_disc(const Mask& mask, int radius_px);

/// All pixels whose disc, as far as it lies in the picture, is set.
Mask erode_disc(const Mask& mask, int radius_px);

/// Dilated, then eroded: fills gaps narrower than the disc.
Mask close_disc(const Mask& mask, int radius_px);

/// Sets unset pixels that no path of unset 4-neighbours connects to the border.
Mask fill_holes(const Mask& mask);

/// All unset pixels become set and the reverse.
Mask complement(const Mask& mask);

}  // namespace espalier
