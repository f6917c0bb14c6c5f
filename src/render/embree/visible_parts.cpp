#include <espalier/render/embree/embree_scene.h>
#include <espalier/render/embree/visible_parts.h>
#include <espalier/render/pixel_rectangle.h>

namespace espalier {

VisibleParts count_visible_parts(const Plant& plant, const Camera& camera) {
  EmbreeScene scene;
  scene.build(plant, stem_tolerance_m(plant, camera));
  const Camera traced = moved_before(camera, scene.box_m());
  const PixelRectangle frame = covered_pixels(traced, scene.box_m());
  VisibleParts seen;
  for (int y = frame.begin_y; y < frame.end_y; ++y)
    for (int x = frame.begin_x; x < frame.end_x; ++x) {
      RTCRayHit hit =
          embree_ray_hit(camera_ray(traced, static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      rtcIntersect1(scene.handle(), &context, &hit);
      if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
      ++(hit.hit.geomID == kStemPart ? seen.wood_px : seen.leaf_px);
    }
  return seen;
}

}  // namespace espalier
