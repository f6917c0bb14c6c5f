// Leaves placed many at a time, see child_batch.h: the same formulas as place_leaf (leaf_placement.h), within
// the rounding of floats. Metres and degrees.
#pragma once
#include "plant/plant.h"
#include "weber_penn/child_batch.h"

namespace espalier {

class LeafBatch : public ChildBatch {
 public:
  LeafBatch(const WeberPennParameters& parameters, ChildBatchMemory& memory, Leaves& leaves)
      : ChildBatch(ChildPlacer::Bears::leaves, parameters, memory), leaves_(leaves) {}

  /// Whether leaves of this stem can be placed in batches: not in fans, on helices, on trunks, or where the
  /// stem swells periodically.
  static bool takes(const GrowingStem& stem, const WeberPennParameters& parameters);

  /// Appends what waits to `leaves`.
  void flush() override;

 private:
  float growth(const GrowingStem& stem, float grown_fraction) const override;
  void note(const GrowingStem& stem, int first_row, int count) override;
  void append_sizes();

  Leaves& leaves_;
  alignas(64) WaitingChildren::Column<LeafKind> kind_;  ///< where some are blossom
};

}  // namespace espalier
