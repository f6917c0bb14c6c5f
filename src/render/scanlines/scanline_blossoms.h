// Blossoms drawn by scan lines, triangle by triangle. Pixels.
#pragma once
#include <espalier/image/masks/mask.h>
#include <espalier/plant/plant.h>
#include <espalier/render/camera.h>

namespace espalier {

/// Sets the pixels whose centres' rays meet a blossom.
void draw_blossoms(const Plant& plant, const Camera& camera, Mask& mask);

}  // namespace espalier
