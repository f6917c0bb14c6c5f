// Stems drawn by scan lines: the silhouettes of the capped cones along each curve. Pixels.
#pragma once
#include <espalier/image/masks/mask.h>
#include <espalier/plant/plant.h>
#include <espalier/render/camera.h>

namespace espalier {

/// Sets the pixels whose centres' rays meet a stem. Curves are cut so finely that their silhouettes stay
/// within an eighth of a pixel.
void draw_stems(const Plant& plant, const Camera& camera, Mask& mask);

}  // namespace espalier
