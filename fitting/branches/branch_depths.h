// How far from the viewer traced axes lie, which no silhouette says. Branches on the trunk lie before and
// behind it in turn, so far that the crown is about as deep as it is wide; what they bear leaves their depth
// by a moderate angle. Pixels.
#pragma once
#include <vector>

#include <espalier/core/random.h>
#include <espalier/image/reading/medial_axes.h>

namespace espalier {

/// Of each point of each axis, how much further from the viewer it is than the foot.
std::vector<std::vector<double>> branch_depths_px(const std::vector<MedialAxis>& axes, RandomKey key);

}  // namespace espalier
