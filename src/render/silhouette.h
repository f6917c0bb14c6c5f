// One silhouette rule: a pixel is set where the ray through its centre meets the plant.
// Renderers of that rule share this interface; the fit knows no more of them.
#pragma once
#include <memory>

#include "image/mask.h"
#include "plant/leaf_sink.h"
#include "plant/plant.h"
#include "render/camera.h"

namespace espalier {

/// A silhouette drawn bit by bit, into a mask that has the camera's size already. Orthographic pictures only.
class SilhouetteParts {
 public:
  virtual ~SilhouetteParts() = default;
  virtual void add_leaves(const LeafColumns& leaves, const Camera& camera, Mask& mask) = 0;
  virtual void add_plant(const Plant& plant, const Camera& camera, Mask& mask) = 0;
};

class SilhouetteRenderer {
 public:
  virtual ~SilhouetteRenderer() = default;
  /// Draws `plant` into `mask`, which gets the camera's size. Not thread-safe: one renderer a thread.
  virtual void draw(const Plant& plant, const Camera& camera, Mask& mask) = 0;
  /// What draws bit by bit; null where a renderer needs the whole plant at once.
  virtual SilhouetteParts* parts() { return nullptr; }
};

/// The reference: traces rays with Embree 3. Stems are cones along the curves, fine enough for the largest
/// picture; leaves are their polygons (render/embree_geometry.h).
std::unique_ptr<SilhouetteRenderer> make_embree_renderer();

/// The fast one, for searches: draws the same pixels by scan lines, but for a few on edges
/// (docs/fast_path.md).
std::unique_ptr<SilhouetteRenderer> make_scanline_renderer();

}  // namespace espalier
