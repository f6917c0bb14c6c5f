// Leaves placed many at a time, see child_batch.h: the same formulas as place_leaf (leaf_placement.h), within
// the rounding of floats. Metres and degrees.
#pragma once
#include <espalier/plant/leaf_sink.h>
#include <espalier/plant/plant.h>
#include <espalier/weber_penn/simd/child_batch.h>

namespace espalier {

class LeafBatch : public ChildBatch {
 public:
  /// Leaves, where none of them are blossom, go to `sink` if it is not null.
  LeafBatch(const WeberPennParameters& parameters, ChildBatchMemory& memory, Leaves& leaves,
            LeafSink* sink = nullptr)
      : ChildBatch(ChildPlacer::Bears::leaves, parameters, memory),
        leaves_(leaves),
        sink_(parameters.blossom_rate > 0 ? nullptr : sink) {}

  /// Whether leaves of this stem can be placed in batches: not in fans, on helices, on trunks, or where the
  /// stem swells periodically.
  static bool supports(const GrowingStem& stem, const WeberPennParameters& parameters);

  /// Appends what waits to `leaves`, or gives it to the sink.
  void flush() override;

  /// How many leaves the sink got.
  std::size_t given() const { return given_; }

 private:
  float growth(const GrowingStem& stem, float grown_fraction) const override;
  void note(const GrowingStem& stem, int first_row, int count) override;
  void give();
  void append();
  void append_sizes();

  Leaves& leaves_;
  LeafSink* sink_;
  std::size_t given_ = 0;
  alignas(64) WaitingChildren::Column<LeafKind> kind_;  ///< where some are blossom
};

}  // namespace espalier
