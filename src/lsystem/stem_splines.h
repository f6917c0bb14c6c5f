// Stems while the turtle draws them. Knots of different stems come interleaved, because a branch interrupts
// its axis; write() sorts them into a plant. Metres.
#pragma once
#include <cstdint>
#include <vector>

#include "plant/plant.h"

namespace espalier::lsystem {

class StemSplines {
 public:
  /// A stem that springs from `parent` (-1: a trunk); it is nothing until its first segment.
  std::int32_t add_stem(std::int32_t parent);
  /// A segment of the stem starts at its last knot; the first one makes that knot.
  void start_segment(std::int32_t stem, Vec3 point_m, float radius_m, PartColor color);
  void end_segment(std::int32_t stem, Vec3 point_m, float radius_m);
  /// Puts the stems into `plant`. Joints are smooth: the tangent at a knot halves the angle of its segments,
  /// and handles reach a third of them; or corners.
  void write(Plant& plant, bool smooth) const;

 private:
  struct Knot {
    Vec3 point_m;
    float radius_m = 0;
    std::int32_t stem = 0;
    PartColor color;  ///< of the segment that starts here
  };
  struct Stem {
    std::int32_t parent = -1;
    std::int32_t last_knot = -1;
    std::uint32_t knot_count = 0, child_count = 0;
  };
  std::vector<Knot> knots_;
  std::vector<Stem> stems_;
  bool has_colors_ = false;
};

}  // namespace espalier::lsystem
