// Where the parts of a plant are fixed to each other, for whoever moves some of them and takes along what
// they bear. A model that knows notes it while it grows.
#pragma once
#include <cstdint>
#include <vector>

#include <espalier/plant/plant.h>

namespace espalier {

/// A place on a stem's curve: on the segment that begins at this knot of the stem, at Bézier parameter t.
struct StemPlace {
  std::uint32_t knot = 0;  ///< counted from the stem's base
  float t = 0;             ///< 0 to 1; 0 at the last knot
};

/// What a stem bears besides stems: a leaf, or the leaves that a surface is drawn with and that keep
/// together.
struct Organ {
  std::int32_t stem = -1;  ///< it hangs on; -1: on none
  StemPlace place;
};

struct PlantJoints {
  std::vector<StemPlace> stem_place;         ///< of each stem on its origin; without meaning for trunks
  std::vector<Organ> organs;                 ///< those of one stem from its base up
  std::vector<std::uint32_t> organ_of_leaf;  ///< for each leaf
};

struct JointedPlant {
  Plant plant;
  PlantJoints joints;
};

}  // namespace espalier
