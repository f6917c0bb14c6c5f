// Exact Euclidean distances of all pixels of a mask (Felzenszwalb, Huttenlocher 2012, Distance transforms of
// sampled functions). For what is computed once a picture; searches use image/measures/distance.h.
#pragma once
#include <vector>

#include <espalier/image/masks/mask.h>

namespace espalier {

/// For each pixel, rows from the top, the distance of its centre to that of the nearest unset pixel, in
/// pixels; 0 where it is unset itself. Beyond the border all is unset.
std::vector<float> distances_to_unset_px(const Mask& mask);

/// The same to the nearest set pixel. Beyond the border nothing is set; an empty mask gives at least 1e5.
std::vector<float> distances_to_set_px(const Mask& mask);

}  // namespace espalier
