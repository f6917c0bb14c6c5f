// Device, scene and geometries of Embree 3; tracing a mask in packets of 8 rays. Metres and pixels.
#include "render/embree_scene.h"

#include <limits>
#include <new>

#include "core/error.h"
#include "render/pixel_rectangle.h"

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

constexpr int kPacket = 8;

void set_ray(RTCRay8& rays, int i, const Ray& ray) {
  rays.org_x[i] = ray.origin_m.x;
  rays.org_y[i] = ray.origin_m.y;
  rays.org_z[i] = ray.origin_m.z;
  rays.dir_x[i] = ray.direction.x;
  rays.dir_y[i] = ray.direction.y;
  rays.dir_z[i] = ray.direction.z;
  rays.tnear[i] = 0;
  rays.tfar[i] = std::numeric_limits<float>::infinity();
  rays.time[i] = 0;
  rays.mask[i] = ~0u;
  rays.id[i] = 0;
  rays.flags[i] = 0;
}

/// Pixels [x, x + 8) of row y as bits, pixel x lowest. Rays beyond `end_x` stay off.
unsigned trace_packet(RTCScene scene, RTCIntersectContext& context, const Camera& camera, int x, int y,
                      int end_x) {
  alignas(32) int valid[kPacket];
  RTCRay8 rays;
  for (int i = 0; i < kPacket; ++i) {
    valid[i] = x + i < end_x ? -1 : 0;
    set_ray(rays, i, camera_ray(camera, static_cast<float>(x + i) + 0.5f, static_cast<float>(y) + 0.5f));
  }
  rtcOccluded8(valid, scene, &context, &rays);
  unsigned bits = 0;
  for (int i = 0; i < kPacket; ++i) bits |= (valid[i] && rays.tfar[i] < 0 ? 1u : 0u) << i;
  return bits;
}

}  // namespace

EmbreeScene::EmbreeScene(SceneQuality quality) : device_(new_device()), scene_(rtcNewScene(device_)) {
  rtcSetSceneBuildQuality(scene_, build_quality(quality));
  constexpr std::array<RTCGeometryType, 3> kTypes{RTC_GEOMETRY_TYPE_ROUND_BEZIER_CURVE,
                                                  RTC_GEOMETRY_TYPE_USER, RTC_GEOMETRY_TYPE_TRIANGLE};
  for (unsigned part = 0; part < kTypes.size(); ++part) {
    geometries_[part] = rtcNewGeometry(device_, kTypes[part]);
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

void EmbreeScene::build(const Plant& plant) {
  stems_.collect(plant);
  leaves_.collect(plant);
  blossoms_.collect(plant);
  update(geometries_[kStemPart], stems_);
  update(geometries_[kLeafPart], leaves_);
  update(geometries_[kBlossomPart], blossoms_);
  rtcCommitScene(scene_);
  check(device_);
  box_m_ = scene_box(scene_);
}

void EmbreeScene::trace(const Camera& camera, Mask& mask) const {
  if (mask.width_px() != camera.width_px || mask.height_px() != camera.height_px)
    mask = Mask(camera.width_px, camera.height_px);
  else
    mask.clear();
  const Camera traced = moved_before(camera, box_m_);
  const PixelRectangle frame = covered_pixels(traced, box_m_);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  for (int y = frame.begin_y; y < frame.end_y; ++y)
    for (int x = frame.begin_x & ~(kPacket - 1); x < frame.end_x; x += kPacket)
      mask.row(y)[static_cast<std::size_t>(x / 64)] |=
          std::uint64_t{trace_packet(scene_, context, traced, x, y, frame.end_x)} << (x % 64);
}

}  // namespace espalier
