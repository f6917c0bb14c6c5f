// The reference renderer of silhouettes: a scene is built for each plant and traced once.
#include <espalier/render/embree/embree_renderer.h>
#include <espalier/render/embree/embree_scene.h>
#include <espalier/render/silhouette.h>

namespace espalier {

namespace {

class EmbreeRenderer final : public SilhouetteRenderer {
 public:
  void draw(const Plant& plant, const Camera& camera, Mask& mask) override {
    scene_.build(plant, stem_tolerance_m(plant, camera));
    scene_.trace(camera, mask);
  }

 private:
  EmbreeScene scene_{SceneQuality::fast_build};
};

}  // namespace

std::unique_ptr<SilhouetteRenderer> make_embree_renderer() { return std::make_unique<EmbreeRenderer>(); }

}  // namespace espalier
