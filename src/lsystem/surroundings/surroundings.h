// What an L-system can ask about the space it grows in: volumes, fields over the ground, and the light that
// the plant of the last step leaves to a point. Units of the L-system; see docs/lsystem.md, Surroundings.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include <espalier/environment/picture_field.h>
#include <espalier/environment/volume.h>
#include <espalier/plant/plant.h>

namespace espalier::lsystem {

class PlantLight;  // light.h
class Work;        // strings/work.h

struct Place {
  double x = 0, y = 0, z = 0;
};

/// A picture on the ground: its middle, and the length that its width has.
struct PlacedField {
  std::shared_ptr<const PictureField> picture;
  double x = 0, y = 0, width = 1;
};

class Surroundings {
 public:
  Surroundings();
  ~Surroundings();

  /// What questions are counted in from now on.
  void set_work(Work& work) { work_ = &work; }

  std::vector<VolumePtr> volumes;
  std::vector<PlacedField> fields;

  /// NaN for a place that is none. Places beyond 1e5 are as those at 1e5.
  double distance(std::size_t volume, Place place) const;
  bool inside(std::size_t volume, Place place) const;
  double field(std::size_t field, Place place) const;
  /// The share of the sun's disc, or of the sky, that can be seen from the place, in [0, 1]; 1 without plant.
  double light(std::size_t, Place place) const;
  double skylight(std::size_t, Place place) const;

  /// What light() sees from now on. What is nearer than `gap` units to a place gives it no shade: the bud
  /// there, and what bears it.
  void set_light(const Plant& plant, double unit_m, Vec3 towards_sun, double gap,
                 std::span<const std::size_t> shades);

 private:
  void count(double units) const;
  const Volume& asked_volume(std::size_t volume) const;

  std::unique_ptr<PlantLight> light_;
  Work* work_ = nullptr;
};

}  // namespace espalier::lsystem
