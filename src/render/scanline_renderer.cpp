// The fast renderer: everything is drawn by scan lines, in the pixels that the Embree reference sets.
// Leaves come first: they cover most of the stems and of each other, and what is covered costs little.
#include "render/scanline_blossoms.h"
#include "render/scanline_leaves.h"
#include "render/scanline_stems.h"
#include "render/silhouette.h"

namespace espalier {

namespace {

class ScanlineRenderer final : public SilhouetteRenderer {
 public:
  void draw(const Plant& plant, const Camera& camera, Mask& mask) override {
    mask.reset(camera.width_px, camera.height_px);
    draw_leaves(plant, camera, mask);
    draw_blossoms(plant, camera, mask);
    draw_stems(plant, camera, mask);
  }
};

}  // namespace

std::unique_ptr<SilhouetteRenderer> make_scanline_renderer() { return std::make_unique<ScanlineRenderer>(); }

}  // namespace espalier
