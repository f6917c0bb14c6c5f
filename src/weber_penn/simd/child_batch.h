// Children are placed many at a time with vector instructions: leaves (leaf_batch.h) and stems (twig_batch.h)
// alike. Those of a stem, or of a segment, that follow one rule are put on its curve together; when some
// hundreds wait, all are turned into place, in passes that are short enough for a processor to overlap one
// vector with the next. The same formulas as ChildPlacer (children.h), within the rounding of floats; the
// same bits on every machine. Metres and degrees.
#pragma once
#include <espalier/weber_penn/scalar/children.h>
#include <espalier/weber_penn/simd/child_spread.h>
#include <espalier/weber_penn/simd/stem_batch.h>
#include <espalier/weber_penn/simd/waiting_children.h>

namespace espalier {

/// Memory that is kept from one plant to the next.
struct ChildBatchMemory {
  ChildSpread spread;
  RollTable rolls;
};

class ChildBatch {
 public:
  /// The memory must outlive the batch.
  ChildBatch(ChildPlacer::Bears bears, const WeberPennParameters& parameters, ChildBatchMemory& memory)
      : p_(parameters), bears_(bears), memory_(memory) {
    memory_.rolls.clear();
    memory_.spread.clear();
  }
  virtual ~ChildBatch() = default;
  ChildBatch(const ChildBatch&) = delete;
  ChildBatch& operator=(const ChildBatch&) = delete;

  /// Takes all children of a segment; `placer` has begun it.
  void add(const GrowingStem& stem, const Segment& segment, ChildPlacer& placer);

  /// Takes all children of a stem that was walked in a batch.
  void add(const GrowingStem& stem, const StemBatch& batch, std::size_t index_in_batch);

  /// Turns what waits into place.
  virtual void flush() = 0;

  int waiting() const { return waiting_.count; }

 protected:
  /// Not on trunks or helices, or where the stem swells periodically.
  static bool takes_children_of(int level, const WeberPennParameters& parameters);

  /// Factor on the size of a child that has grown to this share.
  virtual float growth(const GrowingStem& stem, float grown_fraction) const = 0;
  /// The children from row `first_row` on are those of `stem`.
  virtual void note(const GrowingStem& stem, int first_row, int count) = 0;

  const WeberPennParameters& p_;
  WaitingChildren waiting_;

 private:
  void add_run(const GrowingStem& stem, const Segment& segment, const ChildRun& run, float grown_fraction);
  void add_spread(const GrowingStem& stem, const StemCurve& curve, float count);
  /// Factor on the growth of children along a parent of this level.
  const AlongCurve& growth_along(int parent_level) const;

  ChildPlacer::Bears bears_;
  ChildBatchMemory& memory_;
};

}  // namespace espalier
