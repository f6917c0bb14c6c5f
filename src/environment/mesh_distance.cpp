#include <algorithm>
#include <cstring>
#include <limits>

#include <espalier/core/error.h>
#include <espalier/environment/mesh_distance.h>

namespace espalier {

namespace {

/// The nearest point of a triangle (Ericson 2005, Real-Time Collision Detection, §5.1.5).
Vec3 nearest_in_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 ab = b - a, ac = c - a;
  const float d1 = dot(ab, p - a), d2 = dot(ac, p - a);
  if (d1 <= 0 && d2 <= 0) return a;
  const float d3 = dot(ab, p - b), d4 = dot(ac, p - b);
  if (d3 >= 0 && d4 <= d3) return b;
  const float vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
  const float d5 = dot(ab, p - c), d6 = dot(ac, p - c);
  if (d6 >= 0 && d5 <= d6) return c;
  const float vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
  const float va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  const float sum = va + vb + vc;
  return sum > 0 ? a + ab * (vb / sum) + ac * (vc / sum) : a;
}

struct Nearest {
  const ClosedMesh* mesh;
  float distance_m = std::numeric_limits<float>::infinity();
};

/// Called for triangles whose box the query's ball meets; the ball shrinks to the nearest one so far.
bool visit_triangle(RTCPointQueryFunctionArguments* arguments) {
  auto& nearest = *static_cast<Nearest*>(arguments->userPtr);
  const auto& t = nearest.mesh->triangles[arguments->primID];
  const auto& v = nearest.mesh->vertices_m;
  const Vec3 p{arguments->query->x, arguments->query->y, arguments->query->z};
  const float distance_m = length(p - nearest_in_triangle(p, v[t[0]], v[t[1]], v[t[2]]));
  if (!(distance_m < nearest.distance_m)) return false;
  nearest.distance_m = arguments->query->radius = distance_m;
  return true;
}

template <typename Element>
void fill_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format,
                 const std::vector<Element>& from) {
  static_assert(sizeof(Element) == 12);
  void* buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(Element), from.size());
  if (!buffer) throw std::bad_alloc();
  std::memcpy(buffer, from.data(), sizeof(Element) * from.size());
}

}  // namespace

MeshDistance::MeshDistance(const ClosedMesh& mesh) : mesh_(mesh) {
  device_ = rtcNewDevice("threads=1,set_affinity=0");
  if (!device_) throw InternalError("Embree gave no device");
  scene_ = rtcNewScene(device_);
  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  fill_buffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh_.vertices_m);
  fill_buffer(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh_.triangles);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_);
}

MeshDistance::~MeshDistance() {
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

float MeshDistance::to_surface_m(Vec3 point_m) const {
  Nearest nearest{&mesh_};
  RTCPointQuery query{point_m.x, point_m.y, point_m.z, 0, std::numeric_limits<float>::infinity()};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene_, &query, &context, visit_triangle, &nearest);
  return nearest.distance_m;
}

}  // namespace espalier
