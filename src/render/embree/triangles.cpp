// What triangles of any kind are to Embree: their arrays, read in place.
#include <espalier/render/embree/embree_geometry.h>

namespace espalier {

void Triangles::set_on(RTCGeometry geometry) const {
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, vertices.data(), 0,
                             sizeof(vertices[0]), vertices.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, triangles.data(), 0,
                             sizeof(triangles[0]), triangles.size());
}

}  // namespace espalier
