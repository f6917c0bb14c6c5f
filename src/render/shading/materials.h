// What a ray sees where it meets a plant, what stands beside it or the ground: position, normal towards the
// viewer, colours. Metres; colours are linear RGB.
#pragma once
#include <optional>

#include <espalier/plant/plant.h>
#include <espalier/render/embree/embree_scene.h>
#include <espalier/render/shading/shaded.h>

namespace espalier {

LinearRgb to_linear(PartColor color);

struct Surface {
  Vec3 point_m, normal;   ///< the normal is a unit vector on the viewer's side
  LinearRgb reflected;    ///< share of the light on the viewer's side that comes back
  LinearRgb transmitted;  ///< share of the light on the other side that comes through
  float opacity = 1;      ///< below 1 where the ground fades into the background
};

/// The surfaces of the scene and the ground, with their colours.
class SurfaceFinder {
 public:
  SurfaceFinder(const Plant& plant, const EmbreeScene& scene, const ShadedSettings& settings);

  /// The first surface along the ray, or none.
  std::optional<Surface> first_hit(const Ray& ray) const;

  /// True where anything of the scene lies in this direction, seen from a little above the surface.
  bool is_shadowed(const Surface& surface, Vec3 direction) const;

 private:
  Surface scene_surface(const Ray& ray, const RTCRayHit& hit) const;
  Surface stem_surface(Vec3 point, unsigned primitive) const;
  Surface leaf_surface(std::uint32_t leaf, bool is_blossom) const;
  std::optional<Surface> ground_hit(const Ray& ray) const;

  const Plant& plant_;
  const EmbreeScene& scene_;
  const ShadedSettings& settings_;
  float size_m_;        ///< diagonal of the scene's box
  float bark_scale_m_;  ///< width of the ridges of bark
};

}  // namespace espalier
