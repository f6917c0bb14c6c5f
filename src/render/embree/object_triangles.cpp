// What stands beside the plant, as Embree reads it. Metres.
#include <espalier/render/embree/embree_geometry.h>

namespace espalier {

void ObjectTriangles::collect(const SceneObjects& objects) {
  vertices.clear();
  vertices.reserve(objects.vertices_m.size());
  for (const Vec3 p : objects.vertices_m) vertices.push_back({p.x, p.y, p.z, 0});
  triangles = objects.triangles;
}

void ObjectTriangles::set_on(RTCGeometry geometry) const {
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, vertices.data(), 0,
                             sizeof(vertices[0]), vertices.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, triangles.data(), 0,
                             sizeof(triangles[0]), triangles.size());
}

}  // namespace espalier
