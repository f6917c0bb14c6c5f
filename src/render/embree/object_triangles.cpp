// What stands beside the plant, as Embree reads it. Metres.
#include <espalier/render/embree/embree_geometry.h>

namespace espalier {

void ObjectTriangles::collect(const SceneObjects& objects) {
  vertices.clear();
  vertices.reserve(objects.vertices_m.size());
  for (const Vec3 p : objects.vertices_m) vertices.push_back({p.x, p.y, p.z, 0});
  triangles = objects.triangles;
}

}  // namespace espalier
