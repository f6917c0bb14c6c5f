// Leaves drawn by scan lines: for each, the map from the picture to its outline, and a test of the pixels in
// its box. Pixels. Runs on the best vector instructions of the machine, with the same bits on all.
#pragma once
#include <espalier/image/masks/mask.h>
#include <espalier/plant/leaf_sink.h>
#include <espalier/plant/plant.h>
#include <espalier/render/camera.h>

namespace espalier {

/// Sets the pixels whose centres' rays meet a leaf (not a blossom).
void draw_leaves(const Plant& plant, const Camera& camera, Mask& mask);

/// The same for some leaves of a plant. The camera is orthographic.
void draw_leaves(const LeafColumns& leaves, const Camera& camera, Mask& mask);

}  // namespace espalier
