// Leaves as Embree user geometry: a ray meets the leaf's plane, then the point is tested against the
// outline in the leaf's own coordinates (crossing number; the outline is symmetric, so |x| is tested
// against its right half). Metres; outline coordinates have no unit.
#include <algorithm>
#include <cmath>
#include <limits>

#include <espalier/render/embree/embree_geometry.h>

namespace espalier {

namespace {

constexpr float kSmallestLeafM = 1e-7f;
constexpr float kLargestCoordinateM = 1e9f;

Vec3 absolute(Vec3 a) { return {std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)}; }

bool is_usable(const Bounds& box) {
  const Vec3 a = absolute(box.lower), b = absolute(box.upper);
  return std::max({a.x, a.y, a.z}) < kLargestCoordinateM && std::max({b.x, b.y, b.z}) < kLargestCoordinateM;
}

/// The box of the rectangle around the outline.
Bounds leaf_box(Vec3 position, Vec3 half_side, Vec3 axis) {
  const Vec3 middle = position + axis * 0.5f;
  const Vec3 extent = absolute(half_side) + absolute(axis * 0.5f);
  return {middle - extent, middle + extent};
}

/// Vectors dual to side and axis: x and y are right even where those are not quite at right angles.
LeafPolygons::Plane leaf_plane(Vec3 position, Vec3 side, Vec3 axis) {
  const Vec3 normal = cross(side, axis);
  const float inverse = 1 / dot(normal, normal);
  return {position, normal, cross(axis, normal) * inverse, cross(normal, side) * inverse};
}

bool is_usable(const LeafPolygons::Plane& plane) {
  const float squared = dot(plane.normal, plane.normal);
  return squared > std::numeric_limits<float>::min() && std::isfinite(dot(plane.x_per_m, plane.x_per_m)) &&
         std::isfinite(dot(plane.y_per_m, plane.y_per_m));
}

void collect_leaf(LeafPolygons& polygons, const Leaves& leaves, std::size_t i) {
  if (!(leaves.length_m[i] > kSmallestLeafM) || !(leaves.width_m[i] > kSmallestLeafM)) return;
  const Vec3 side = leaves.side[i] * leaves.width_m[i], axis = leaves.axis[i] * leaves.length_m[i];
  const Bounds box = leaf_box(leaves.position_m[i], side * polygons.half->half_width, axis);
  const LeafPolygons::Plane plane = leaf_plane(leaves.position_m[i], side, axis);
  if (!is_usable(box) || !is_usable(plane)) return;
  polygons.planes.push_back(plane);
  polygons.boxes.push_back(box);
  polygons.leaf.push_back(static_cast<std::uint32_t>(i));
}

void box_callback(const RTCBoundsFunctionArguments* arguments) {
  const auto& polygons = *static_cast<const LeafPolygons*>(arguments->geometryUserPtr);
  const Bounds& box = polygons.boxes[arguments->primID];
  *arguments->bounds_o = {box.lower.x, box.lower.y, box.lower.z, 0, box.upper.x, box.upper.y, box.upper.z, 0};
}

/// Distance to the leaf along ray i of the packet, in lengths of its direction; infinite where it misses.
float hit_distance(const LeafPolygons& polygons, unsigned primitive, RTCRayN* rays, unsigned n, unsigned i) {
  constexpr float kMiss = std::numeric_limits<float>::infinity();
  const LeafPolygons::Plane& plane = polygons.planes[primitive];
  const Vec3 direction{RTCRayN_dir_x(rays, n, i), RTCRayN_dir_y(rays, n, i), RTCRayN_dir_z(rays, n, i)};
  const Vec3 from_stalk =
      Vec3{RTCRayN_org_x(rays, n, i), RTCRayN_org_y(rays, n, i), RTCRayN_org_z(rays, n, i)} -
      plane.position_m;
  const float distance = -dot(from_stalk, plane.normal) / dot(direction, plane.normal);
  if (!(distance > RTCRayN_tnear(rays, n, i) && distance < RTCRayN_tfar(rays, n, i))) return kMiss;
  const Vec3 point = from_stalk + direction * distance;
  const float y = dot(point, plane.y_per_m);
  if (!(y >= 0 && y <= 1)) return kMiss;
  const float x = std::fabs(dot(point, plane.x_per_m));
  return x <= polygons.half->half_width && polygons.half->contains(x, y) ? distance : kMiss;
}

void occluded_callback(const RTCOccludedFunctionNArguments* arguments) {
  const auto& polygons = *static_cast<const LeafPolygons*>(arguments->geometryUserPtr);
  for (unsigned i = 0; i < arguments->N; ++i)
    if (arguments->valid[i] &&
        std::isfinite(hit_distance(polygons, arguments->primID, arguments->ray, arguments->N, i)))
      RTCRayN_tfar(arguments->ray, arguments->N, i) = -std::numeric_limits<float>::infinity();
}

void record_hit(const RTCIntersectFunctionNArguments* arguments, Vec3 normal, float distance, unsigned i) {
  RTCRayN* ray = RTCRayHitN_RayN(arguments->rayhit, arguments->N);
  RTCHitN* hit = RTCRayHitN_HitN(arguments->rayhit, arguments->N);
  RTCRayN_tfar(ray, arguments->N, i) = distance;
  RTCHitN_Ng_x(hit, arguments->N, i) = normal.x;
  RTCHitN_Ng_y(hit, arguments->N, i) = normal.y;
  RTCHitN_Ng_z(hit, arguments->N, i) = normal.z;
  RTCHitN_primID(hit, arguments->N, i) = arguments->primID;
  RTCHitN_geomID(hit, arguments->N, i) = arguments->geomID;
  RTCHitN_instID(hit, arguments->N, i, 0) = RTC_INVALID_GEOMETRY_ID;
}

void intersect_callback(const RTCIntersectFunctionNArguments* arguments) {
  const auto& polygons = *static_cast<const LeafPolygons*>(arguments->geometryUserPtr);
  RTCRayN* ray = RTCRayHitN_RayN(arguments->rayhit, arguments->N);
  for (unsigned i = 0; i < arguments->N; ++i) {
    if (!arguments->valid[i]) continue;
    const float distance = hit_distance(polygons, arguments->primID, ray, arguments->N, i);
    if (std::isfinite(distance))
      record_hit(arguments, polygons.planes[arguments->primID].normal, distance, i);
  }
}

}  // namespace

void LeafPolygons::collect(const Plant& plant) {
  planes.clear();
  boxes.clear();
  leaf.clear();
  half = &leaf_half(plant.leaf_shape);
  for (std::size_t i = 0; i < plant.leaves.size(); ++i)
    if (plant.leaves.kind[i] == LeafKind::leaf) collect_leaf(*this, plant.leaves, i);
}

void LeafPolygons::set_on(RTCGeometry geometry) {
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(planes.size()));
  rtcSetGeometryUserData(geometry, this);
  rtcSetGeometryBoundsFunction(geometry, box_callback, nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect_callback);
  rtcSetGeometryOccludedFunction(geometry, occluded_callback);
}

}  // namespace espalier
