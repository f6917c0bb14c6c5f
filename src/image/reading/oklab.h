// Colours in which equal steps look equal. Ottosson, A perceptual color space for image processing, 2020.
#pragma once
#include <Eigen/Core>

namespace espalier {

/// Lightness 0 … 1, green (-) to red (+), blue (-) to yellow (+); of sRGB 0 … 1.
Eigen::Vector3d oklab_of(const Eigen::Vector3d& srgb);

/// Distance from grey.
inline double chroma_of(const Eigen::Vector3d& oklab) { return oklab.tail<2>().norm(); }

}  // namespace espalier
