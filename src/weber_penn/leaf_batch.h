// Leaves are placed many at a time: while stems grow, each leaf is noted as a place on a segment; when enough
// are noted, all are turned into positions and directions with vector instructions. The same formulas as
// place_leaf (leaf_placement.h), within the rounding of floats; the same bits on every machine.
// Metres and degrees.
#pragma once
#include <array>
#include <cstdint>

#include "plant/plant.h"
#include "weber_penn/children.h"

namespace espalier {

/// A segment as the vector code reads it, one row of floats.
struct LeafSegment {
  Vec3 start_m, handle_out_m, handle_in_m, end_m;
  Vec3 heading;  ///< at its end
  Vec3 across;   ///< forward × right at its end: with the tangent it spans the plane of `right`
  float base_radius_m, stem_length_m;
};

/// Notes of leaves: column i of each array is one leaf.
struct LeafNotes {
  static constexpr int kMost = 256;
  int count = 0, segments = 0;
  std::array<LeafSegment, kMost> segment;
  alignas(64) std::array<float, kMost> t{}, z{}, roll_deg{},
      jitter{};                                   ///< t along the segment, z along the stem
  alignas(64) std::array<float, kMost> growth{};  ///< of its size, relative to leaf_scale
  std::array<LeafKind, kMost> kind{};
  alignas(64) std::array<std::int32_t,
                         kMost> segment_index{};  ///< also beyond count, where vectors end, a row there is
};

class LeafBatch {
 public:
  LeafBatch(const WeberPennParameters& parameters, Leaves& leaves) : p_(parameters), leaves_(leaves) {}

  /// Whether leaves of this stem can be placed in batches: not in fans, on helices, on trunks, or where the
  /// stem swells periodically.
  static bool takes(const GrowingStem& stem, const WeberPennParameters& parameters);

  /// Notes all leaves of a segment; `placer` has begun it.
  void add(const GrowingStem& stem, const Segment& segment, ChildPlacer& placer);

  /// Appends what is noted to `leaves`.
  void flush();

  int noted() const { return notes_.count; }

 private:
  void note(const GrowingStem& stem, const ChildSlot& slot, float z);
  void append_sizes();

  const WeberPennParameters& p_;
  Leaves& leaves_;
  LeafNotes notes_;
};

}  // namespace espalier
