// Device, scene and geometries of Embree 3; tracing a mask in tiles of 8×8 rays. Metres and pixels.
#include <algorithm>
#include <limits>
#include <new>

#include <espalier/core/error.h>
#include <espalier/render/embree/embree_scene.h>
#include <espalier/render/pixel_rectangle.h>

namespace espalier {

namespace {

RTCDevice new_device() {
  RTCDevice device = rtcNewDevice("threads=1,set_affinity=0");
  if (device == nullptr)
    throw InternalError(
        fmt::format("Embree gave no device: error {}", static_cast<int>(rtcGetDeviceError(nullptr))));
  return device;
}

void check(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  if (error != RTC_ERROR_NONE)
    throw InternalError(fmt::format("Embree reports error {}", static_cast<int>(error)));
}

RTCBuildQuality build_quality(SceneQuality quality) {
  return quality == SceneQuality::fast_build ? RTC_BUILD_QUALITY_LOW : RTC_BUILD_QUALITY_HIGH;
}

/// Geometries without primitives are switched off: their buffers would be empty.
template <typename Geometry>
void update(RTCGeometry geometry, Geometry& contents) {
  if (contents.size() == 0) {
    rtcDisableGeometry(geometry);
    return;
  }
  contents.set_on(geometry);
  rtcEnableGeometry(geometry);
  rtcCommitGeometry(geometry);
}

Bounds scene_box(RTCScene scene) {
  RTCBounds box;
  rtcGetSceneBounds(scene, &box);
  if (!(box.lower_x <= box.upper_x)) return {};
  return {{box.lower_x, box.lower_y, box.lower_z}, {box.upper_x, box.upper_y, box.upper_z}};
}

constexpr int kTile = 8;

RTCRay embree_ray(const Ray& ray) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const Vec3 origin = ray.origin_m, direction = ray.direction;
  return {origin.x, origin.y, origin.z, 0, direction.x, direction.y, direction.z, 0, kInfinity, ~0u, 0, 0};
}

/// Traces the pixels [x, x + 8) × [y, y + 8) inside of `frame`; x is a multiple of 8.
void trace_tile(RTCScene scene, const Camera& camera, const PixelRectangle& frame, int x, int y, Mask& mask) {
  std::array<RTCRay, kTile * kTile> rays;
  unsigned count = 0;
  const int end_x = std::min(x + kTile, frame.end_x), end_y = std::min(y + kTile, frame.end_y);
  for (int j = y; j < end_y; ++j)
    for (int i = x; i < end_x; ++i)
      rays[count++] =
          embree_ray(camera_ray(camera, static_cast<float>(i) + 0.5f, static_cast<float>(j) + 0.5f));
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1M(scene, &context, rays.data(), count, sizeof(RTCRay));
  const RTCRay* ray = rays.data();
  for (int j = y; j < end_y; ++j) {
    std::uint64_t bits = 0;
    for (int i = x; i < end_x; ++i) bits |= std::uint64_t{ray++->tfar < 0} << (i % 64);
    mask.row(j)[static_cast<std::size_t>(x / 64)] |= bits;
  }
}

/// The nearest depth of the knots; leaves stand at most a leaf nearer.
float nearest_depth_m(const Plant& plant, const Camera& camera) {
  float nearest_m = std::numeric_limits<float>::infinity();
  for (const Vec3 point : plant.knots.point_m)
    nearest_m = std::min(nearest_m, dot(point - camera.position_m, camera.forward));
  return nearest_m;
}

}  // namespace

float stem_tolerance_m(const Plant& plant, const Camera& camera) {
  constexpr float kPixels = 0.125f, kSmallestM = 1e-6f;
  if (camera.projection == Projection::orthographic)
    return std::max(kSmallestM, kPixels * camera.metres_per_px);
  return std::max(kSmallestM, kPixels * camera.metres_per_px * nearest_depth_m(plant, camera));
}

EmbreeScene::EmbreeScene(SceneQuality quality, StemSurface surface)
    : device_(new_device()), scene_(rtcNewScene(device_)), surface_(surface) {
  rtcSetSceneBuildQuality(scene_, build_quality(quality));
  const std::array<RTCGeometryType, 4> types{
      surface == StemSurface::cones ? RTC_GEOMETRY_TYPE_CONE_LINEAR_CURVE
                                    : RTC_GEOMETRY_TYPE_ROUND_BEZIER_CURVE,
      RTC_GEOMETRY_TYPE_USER, RTC_GEOMETRY_TYPE_TRIANGLE, RTC_GEOMETRY_TYPE_TRIANGLE};
  for (unsigned part = 0; part < types.size(); ++part) {
    geometries_[part] = rtcNewGeometry(device_, types[part]);
    rtcSetGeometryBuildQuality(geometries_[part], build_quality(quality));
    rtcAttachGeometryByID(scene_, geometries_[part], part);
  }
  check(device_);
}

EmbreeScene::~EmbreeScene() {
  for (const RTCGeometry geometry : geometries_) rtcReleaseGeometry(geometry);
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

void EmbreeScene::build(const Plant& plant, float tolerance_m, const SceneObjects& objects) {
  stems_.collect(plant, surface_, tolerance_m);
  leaves_.collect(plant);
  blossoms_.collect(plant);
  objects_.collect(objects);
  update(geometries_[kStemPart], stems_);
  update(geometries_[kLeafPart], leaves_);
  update(geometries_[kBlossomPart], blossoms_);
  update(geometries_[kObjectPart], objects_);
  rtcCommitScene(scene_);
  check(device_);
  box_m_ = scene_box(scene_);
}

RTCRayHit embree_ray_hit(const Ray& ray) {
  RTCRayHit out{};
  out.ray = {ray.origin_m.x,
             ray.origin_m.y,
             ray.origin_m.z,
             0,
             ray.direction.x,
             ray.direction.y,
             ray.direction.z,
             0,
             std::numeric_limits<float>::infinity(),
             ~0u,
             0,
             0};
  out.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  return out;
}

void EmbreeScene::trace(const Camera& camera, Mask& mask) const {
  mask.reset(camera.width_px, camera.height_px);
  const Camera traced = moved_before(camera, box_m_);
  const PixelRectangle frame = covered_pixels(traced, box_m_);
  for (int y = frame.begin_y; y < frame.end_y; y += kTile)
    for (int x = frame.begin_x - frame.begin_x % kTile; x < frame.end_x; x += kTile)
      trace_tile(scene_, traced, frame, x, y, mask);
}

}  // namespace espalier
