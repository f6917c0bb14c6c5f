// Stems drawn by scan lines: the silhouettes of the capped cones along each curve. Pixels.
#pragma once
#include "image/mask.h"
#include "plant/plant.h"
#include "render/camera.h"

namespace espalier {

/// Sets the pixels whose centres' rays meet a stem. Curves are cut so finely that their silhouettes stay
/// within an eighth of a pixel.
void draw_stems(const Plant& plant, const Camera& camera, Mask& mask);

}  // namespace espalier
