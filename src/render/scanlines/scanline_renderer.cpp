// The fast renderer: everything is drawn by scan lines, in the pixels that the Embree reference sets.
// Leaves come first: they cover most of the stems and of each other, and what is covered costs little.
#include <espalier/render/scanlines/scanline_blossoms.h>
#include <espalier/render/scanlines/scanline_leaves.h>
#include <espalier/render/scanlines/scanline_renderer.h>
#include <espalier/render/scanlines/scanline_stems.h>
#include <espalier/render/silhouette.h>

namespace espalier {

namespace {

class ScanlineRenderer final : public SilhouetteRenderer, private SilhouetteParts {
 public:
  void draw(const Plant& plant, const Camera& camera, Mask& mask) override {
    mask.reset(camera.width_px, camera.height_px);
    add_plant(plant, camera, mask, nullptr);
  }
  void draw_apart(const Plant& plant, const Camera& camera, Mask& mask, Mask& leaves) override {
    mask.reset(camera.width_px, camera.height_px);
    add_plant(plant, camera, mask, &leaves);
  }
  SilhouetteParts* parts() override { return this; }

 private:
  void add_leaves(const LeafColumns& leaves, const Camera& camera, Mask& mask) override {
    draw_leaves(leaves, camera, mask);
  }
  void add_plant(const Plant& plant, const Camera& camera, Mask& mask, Mask* leaves) override {
    draw_leaves(plant, camera, mask);
    draw_blossoms(plant, camera, mask);
    if (leaves) *leaves = mask;
    draw_stems(plant, camera, mask);
  }
};

}  // namespace

std::unique_ptr<SilhouetteRenderer> make_scanline_renderer() { return std::make_unique<ScanlineRenderer>(); }

}  // namespace espalier
