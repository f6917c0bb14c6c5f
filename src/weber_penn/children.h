// Where children sit on a stem and which way they point: stems and leaves alike [CH §3.2.1 Branch
// Distribution, §3.2.2]. Metres and degrees.
#pragma once
#include "weber_penn/stem_walk.h"

namespace espalier {

/// One place for a child on its parent's axis.
struct ChildSite {
  int index = 0;              ///< along the parent, from its base
  Turtle turtle;              ///< on the axis of the parent, heading along the child
  Vec3 outward;               ///< unit normal of the parent on the child's side
  float offset_m = 0;         ///< along the parent
  float parent_radius_m = 0;  ///< at the offset
  float grown_fraction = 1;   ///< under 1 for the last child of a relaxed count
};

/// Expected number of child stems on a stem, not rounded; negative: that many in a fan at its tip.
float child_stem_count(const GrowingStem& stem, const WeberPennParameters& parameters);

/// Number of leaves on a stem of the last level; negative: that many in a fan at its tip.
float leaf_count(const GrowingStem& stem, const WeberPennParameters& parameters);

/// Places children segment by segment. The spread over segments is the error diffusion of [CH §3.2.1]:
/// child i appears in the segment in which the running count passes i + 1, at the middle of its share.
class ChildPlacer {
 public:
  enum class Bears { stems, leaves };

  /// Counts are those above, for the whole stem if it were no clone and did not split.
  ChildPlacer(const GrowingStem& stem, Bears bears, const WeberPennParameters& parameters);

  /// Starts a segment; then next() yields its children until it returns false.
  void begin(const GrowingStem& stem, const Segment& segment);
  bool next(ChildSite& site);

 private:
  bool next_along(ChildSite& site);
  bool next_in_whorl(ChildSite& site);
  bool next_in_fan(ChildSite& site);
  bool site_at(float t, float roll_deg, ChildSite& site);
  float next_rotation_deg();
  float down_angle_deg(float offset_m) const;
  Turtle frame_at(float t) const;

  const WeberPennParameters& p_;
  Bears bears_;
  GrowingStem stem_;
  Segment segment_;
  float count_;
  int child_level_;     ///< index of the child's level values
  float distribution_;  ///< branch_dist
  float reached_ = 0, before_ = 0,
        rate_ = 0;  ///< running count after and before this segment, and per segment
  int placed_ = 0;  ///< children so far
  int whorl_ = 0, in_whorl_ = 0;
  float rotation_deg_;
  bool last_segment_ = false;
};

}  // namespace espalier
