// The segments of a stem that follows a drawn axis (core/curves/axis.h): evenly spaced along it, with the
// axis's own directions at their ends. The axis says the form of the stem, and its length how large that is.
// The frame is carried along without a twist about the axis (a rotation-minimising frame). What an override
// or training bends the stem beside that turns its parts as on any stem.
#pragma once
#include <espalier/weber_penn/scalar/stem_walk.h>

namespace espalier {

class AxisWalk {
 public:
  /// A stem that has an axis; a clone has the whole of its own.
  AxisWalk(const GrowingStem& stem, const WeberPennParameters& parameters);
  /// The next one; segment_count(stem, parameters) are those of a stem that starts at its base.
  Segment next();

 private:
  Vec3 in_world(AxisPoint v) const;
  Vec3 direction_at(double share) const;
  float bend_deg(float z) const;
  void turn_towards(Vec3 heading);

  const AxisCurve& curve_;
  AxisArcs arcs_;
  ExtraCurve extra_curve_;
  int index_, count_;
  float first_z_;  ///< along the whole stem, where it starts
  float segment_m_;
  Vec3 x_, y_, z_;  ///< of the axis's frame
  Vec3 bend_axis_;
  AxisPoint drawn_end_;  ///< of the last segment, as drawn
  double metres_per_drawn_;
  StemTurtle turtle_;  ///< there
};

}  // namespace espalier
