// Stems while the turtle draws them. Knots of different stems come interleaved, because a branch interrupts
// its axis; write() sorts them into a plant. Metres.
#pragma once
#include <cstdint>
#include <vector>

#include <espalier/plant/joints.h>

namespace espalier::lsystem {

class StemSplines {
 public:
  /// A stem that springs from `parent` (-1: a trunk) at this place; it is nothing until its first segment.
  std::int32_t add_stem(std::int32_t parent, StemPlace place);
  std::int32_t add_stem(std::int32_t parent) { return add_stem(parent, last_knot_of(parent)); }
  /// The place of its last knot so far.
  StemPlace last_knot_of(std::int32_t stem) const;
  /// A segment of the stem starts at its last knot; the first one makes that knot.
  void start_segment(std::int32_t stem, Vec3 point_m, float radius_m, PartColor color);
  void end_segment(std::int32_t stem, Vec3 point_m, float radius_m);
  /// Puts the stems into `plant`. Joints are smooth: the tangent at a knot halves the angle of its segments,
  /// and handles reach a third of them; or corners.
  void write(Plant& plant, bool smooth, std::vector<StemPlace>& stem_place) const;

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
    std::uint32_t knot_count = 0;
    StemPlace place;  ///< on the parent
  };
  std::vector<Knot> knots_;
  std::vector<Stem> stems_;
  bool has_colors_ = false;
};

}  // namespace espalier::lsystem
