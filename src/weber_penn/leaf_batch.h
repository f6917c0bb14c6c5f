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

/// A run of leaves on a segment as the vector code reads it, one row of floats: the segment's curve and
/// frame, its stem, and the rule of the run [children.h].
struct LeafRow {
  Vec3 start_m, handle_out_m, handle_in_m, end_m;
  Vec3 heading;  ///< at its end
  Vec3 across;   ///< forward × right at its end: with the tangent it spans the plane of `right`
  float base_radius_m, stem_length_m;
  float z_start, z_length;  ///< of the segment, along the stem
  float t_start, t_step, t_odd, roll_deg, roll_step_deg;
};

/// Notes of leaves: column i of each array is one leaf.
struct LeafNotes {
  static constexpr int kMost = 256;
  int count = 0, rows = 0;
  std::array<LeafRow, kMost> row;
  alignas(
      64) std::array<std::int32_t, kMost> row_index{};   ///< beyond count, where vectors end, a row there is
  alignas(64) std::array<std::int32_t, kMost> in_run{};  ///< k of the run
  alignas(64) std::array<float, kMost> jitter{};         ///< of the down angle, in [-1, 1)
  alignas(64) std::array<float, kMost> growth{};         ///< of its size, relative to leaf_scale
  std::array<LeafKind, kMost> kind{};
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
  void note_run(const GrowingStem& stem, const Segment& segment, ChildRun run, float grown_fraction);
  void append_sizes();

  const WeberPennParameters& p_;
  Leaves& leaves_;
  LeafNotes notes_;
};

}  // namespace espalier
