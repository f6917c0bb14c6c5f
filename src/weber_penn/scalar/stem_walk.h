// Walking along a stem: its segments as cubic Bézier curves, how it turns between them and where it
// splits. The same walk tests a stem against the pruning envelope and then grows it: all draws are
// keyed, so both see the same curve [CH §3.2.1 Pruning].
#pragma once
#include <espalier/weber_penn/scalar/stem.h>

namespace espalier {

/// One segment of a stem: control points in metres, z in [0, 1] along the whole stem.
struct Segment {
  Vec3 start_m, handle_out_m, handle_in_m, end_m;
  float z_start = 0, z_end = 0;
  StemTurtle end;  ///< on arrival, before the stem turns
  bool helical = false;
};

Vec3 segment_point(const Segment& segment, float t);
Vec3 segment_tangent(const Segment& segment, float t);  ///< unit

/// How much an override bends a stem of this level more than the parameters do.
ExtraCurve extra_curve(const BranchChange* change, int level, const WeberPennParameters& parameters);

/// Factor of curve_along on the bend at segment end `at` of a stem of this level index.
inline float curve_factor(int level, int at, int segments, const WeberPennParameters& p) {
  const AlongCurve& along = p.curves.curve_along[level];
  return along.is_neutral ? 1 : along.at(static_cast<float>(at) / static_cast<float>(segments));
}

/// The sideways bend there by bend_along, which is nowhere random.
inline float steady_bend_deg(int level, int at, int segments, const WeberPennParameters& p) {
  const AlongCurve& along = p.curves.bend_along[level];
  if (along.is_neutral) return 0;
  return along.at(static_cast<float>(at) / static_cast<float>(segments)) / static_cast<float>(segments);
}

class StemVisitor {
 public:
  virtual ~StemVisitor() = default;
  /// Segments come in order; false ends the walk. `stem` carries the branch factor after the last split.
  virtual bool segment(const GrowingStem& stem, const Segment& segment) = 0;
  /// A clone that starts at the end of the last segment.
  virtual void split(const GrowingStem& clone) = 0;
};

/// Walks from the stem's first segment to its tip.
void walk_stem(GrowingStem stem, const WeberPennParameters& parameters, StemVisitor& visitor);

}  // namespace espalier
