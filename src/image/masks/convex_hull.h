// The convex hull of what is set in a mask.
#pragma once
#include <espalier/image/masks/mask.h>

namespace espalier {

/// The area of the smallest convex shape that holds all set pixels, as squares; 0 for an empty mask.
double convex_hull_area_px(const Mask& mask);

}  // namespace espalier
