// Light that reaches points of a growing plant: rays to the sun's disc or to the sky that neither the plant
// (Embree's occlusion) nor a volume (sphere tracing, Hart 1996) stops. Units of the L-system.
#pragma once
#include <vector>

#include <espalier/environment/volume.h>
#include <espalier/render/embree/embree_scene.h>

namespace espalier::lsystem {

struct LightShare {
  double free = 1;  ///< in [0, 1]
  double work = 0;  ///< of finding it (strings/work.h)
};

class PlantLight {
 public:
  PlantLight();
  void set(const Plant& plant, double unit_m, Vec3 towards_sun, double gap, std::vector<VolumePtr> shades);
  /// Of the sun, a disc of 6°, and of the sky, where what is high counts for more (cosine
  /// law).
  LightShare of_sun(Vec3 place) const { return share(sun_, place); }
  LightShare of_sky(Vec3 place) const { return share(sky_, place); }

 private:
  LightShare share(const std::vector<Vec3>& directions, Vec3 place) const;
  bool is_free(Vec3 place, Vec3 direction, double& work) const;

  EmbreeScene scene_;
  float unit_m_ = 1, gap_ = 0;
  std::vector<VolumePtr> shades_;
  std::vector<Vec3> sun_, sky_;
};

}  // namespace espalier::lsystem
