// One silhouette rule: a pixel is set where the ray through its centre meets the plant.
// Renderers of that rule share this interface; the fit knows no more of them.
#pragma once
#include <memory>

#include <espalier/image/masks/mask.h>
#include <espalier/plant/leaf_sink.h>
#include <espalier/plant/plant.h>
#include <espalier/render/camera.h>

namespace espalier {

/// A silhouette drawn bit by bit, into a mask that has the camera's size already. Orthographic pictures only.
class SilhouetteParts {
 public:
  virtual ~SilhouetteParts() = default;
  virtual void add_leaves(const LeafColumns& leaves, const Camera& camera, Mask& mask) = 0;
  /// Draws what is left of the plant. `leaves`, unless null, gets what leaves and blossoms cover.
  virtual void add_plant(const Plant& plant, const Camera& camera, Mask& mask, Mask* leaves) = 0;
};

class SilhouetteRenderer {
 public:
  virtual ~SilhouetteRenderer() = default;
  /// Draws `plant` into `mask`, which gets the camera's size. Not thread-safe: one renderer a thread.
  virtual void draw(const Plant& plant, const Camera& camera, Mask& mask) = 0;
  /// The same, and in `leaves` what leaves and blossoms cover of it, be it before or behind wood.
  virtual void draw_apart(const Plant& plant, const Camera& camera, Mask& mask, Mask& leaves);
  /// What draws bit by bit; null where a renderer needs the whole plant at once.
  virtual SilhouetteParts* parts() { return nullptr; }
};

}  // namespace espalier
