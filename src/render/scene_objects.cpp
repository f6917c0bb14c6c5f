// The frame of pictures with objects in them.
#include <algorithm>

#include <espalier/render/scene_objects.h>

namespace espalier {

Bounds bounds(const Plant& plant, const SceneObjects& objects) {
  Bounds box = bounds(plant);
  for (const Vec3 p : objects.vertices_m) {
    box.lower = {std::min(box.lower.x, p.x), std::min(box.lower.y, p.y), std::min(box.lower.z, p.z)};
    box.upper = {std::max(box.upper.x, p.x), std::max(box.upper.y, p.y), std::max(box.upper.z, p.z)};
  }
  return box;
}

}  // namespace espalier
