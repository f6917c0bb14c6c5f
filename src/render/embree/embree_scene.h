// A plant as an Embree 3 scene that rays are traced through: for masks and for shaded pictures. Metres.
// One device with one thread a scene, so that scenes build and trace at the same time in several threads
// with the same bits. Building reuses all memory of the plant before.
#pragma once
#include <embree3/rtcore.h>

#include <array>
#include <cstdint>

#include <espalier/image/masks/mask.h>
#include <espalier/plant/plant.h>
#include <espalier/render/camera.h>
#include <espalier/render/embree/embree_geometry.h>

namespace espalier {

/// Fast to build for one mask, or fast to trace for pictures with many rays.
enum class SceneQuality { fast_build, fast_trace };

/// What a ray hits: Embree's geomID.
enum GeometryId : unsigned { kStemPart = 0, kLeafPart = 1, kBlossomPart = 2, kObjectPart = 3 };

/// How closely a picture by `camera` needs stems to be followed: an eighth of a pixel where the plant is
/// nearest.
float stem_tolerance_m(const Plant& plant, const Camera& camera);

/// A ray of unbounded length, as Embree takes it.
RTCRayHit embree_ray_hit(const Ray& ray);

class EmbreeScene {
 public:
  explicit EmbreeScene(SceneQuality quality = SceneQuality::fast_build,
                       StemSurface surface = StemSurface::cones);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  /// Replaces the contents. Cones keep within `tolerance_m` (> 0) of the stems' curves.
  /// The plant and what stands beside it are copied: they may change or vanish afterwards.
  void build(const Plant& plant, float tolerance_m, const SceneObjects& objects = {});

  /// Sets the pixels whose centre's ray meets the scene. `mask` gets the camera's size.
  void trace(const Camera& camera, Mask& mask) const;

  /// Contains everything a ray can hit; zero-sized at the origin for an empty scene.
  Bounds box_m() const { return box_m_; }

  RTCScene handle() const { return scene_; }
  const StemSegments& stems() const { return stems_; }
  const LeafPolygons& leaves() const { return leaves_; }
  const BlossomTriangles& blossoms() const { return blossoms_; }

 private:
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
  std::array<RTCGeometry, 4> geometries_{};
  StemSurface surface_;
  StemSegments stems_;
  LeafPolygons leaves_;
  BlossomTriangles blossoms_;
  ObjectTriangles objects_;
  Bounds box_m_;
};

}  // namespace espalier
