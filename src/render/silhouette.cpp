#include <espalier/render/silhouette.h>

namespace espalier {

void SilhouetteRenderer::draw_apart(const Plant& plant, const Camera& camera, Mask& mask, Mask& leaves) {
  draw(plant, camera, mask);
  Plant foliage;
  foliage.leaves = plant.leaves;
  foliage.leaf_shape = plant.leaf_shape;
  foliage.blossom_shape = plant.blossom_shape;
  draw(foliage, camera, leaves);
}

}  // namespace espalier
