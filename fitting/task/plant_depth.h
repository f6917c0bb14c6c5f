// How deep a plant is, which a single picture does not show: a crown that is as flat as the picture, or twice
// as deep as wide, may lie on it just as well.
#pragma once
#include <espalier/plant/plant.h>
#include <espalier/render/camera.h>

namespace espalier {

/// Of the plant's wood, along the camera's direction and across it, both level; 1 where it has no width or no
/// depth.
double depth_over_width(const Plant& plant, const Camera& camera);

/// How far a depth over width is beyond what bundled species have, as a logarithm: ln 2 for a plant twice as
/// deep as the deepest, or half as deep as the flattest of them. 0 for all between.
double depth_excess(double depth_over_width);

}  // namespace espalier
