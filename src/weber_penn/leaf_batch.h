// Leaves are placed many at a time with vector instructions. Those of a segment that follow one rule are put
// on its curve together; when some hundreds wait, all are turned into place, in passes that are short enough
// for a processor to overlap one vector with the next. The same formulas as place_leaf (leaf_placement.h),
// within the rounding of floats; the same bits on every machine. Metres and degrees.
#pragma once
#include <array>
#include <cstdint>

#include "plant/plant.h"
#include "weber_penn/children.h"

namespace espalier {

/// Leaves on their way to the plant, a column for each number. Whole vectors are written: some rows beyond
/// `count` hold nothing.
struct WaitingLeaves {
  static constexpr int kMost = 256;
  template <typename T>
  using Column = std::array<T, kMost + 8>;
  struct Columns3 {
    alignas(64) Column<float> x, y, z;
  };
  int count = 0;
  Columns3 point;    ///< on the stem's axis
  Columns3 tangent;  ///< along it, of any length
  Columns3 across;  ///< forward × right at the segment's end: with the tangent it spans the plane of `right`
  Columns3 right;   ///< of the unrolled frame
  alignas(64) Column<float> stem_radius_m, roll_deg, down_deg;
  alignas(64) Column<float> growth;  ///< of the size, relative to leaf_scale
  alignas(64) Column<LeafKind> kind;
};

class LeafBatch {
 public:
  LeafBatch(const WeberPennParameters& parameters, Leaves& leaves) : p_(parameters), leaves_(leaves) {}

  /// Whether leaves of this stem can be placed in batches: not in fans, on helices, on trunks, or where the
  /// stem swells periodically.
  static bool takes(const GrowingStem& stem, const WeberPennParameters& parameters);

  /// Takes all leaves of a segment; `placer` has begun it.
  void add(const GrowingStem& stem, const Segment& segment, ChildPlacer& placer);

  /// Places what waits, and appends it to `leaves`.
  void flush();

  int waiting() const { return waiting_.count; }

 private:
  void add_run(const GrowingStem& stem, const Segment& segment, const ChildRun& run, float grown_fraction);
  void append_sizes();

  const WeberPennParameters& p_;
  Leaves& leaves_;
  WaitingLeaves waiting_;
};

}  // namespace espalier
