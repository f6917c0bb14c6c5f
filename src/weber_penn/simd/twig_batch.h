// Child stems made many at a time, see child_batch.h: what Growth::grow_child makes of a site one by one
// (grow.cpp), within the rounding of floats. Metres and degrees.
#pragma once
#include <optional>
#include <vector>

#include <espalier/plant/model.h>
#include <espalier/weber_penn/scalar/envelope_floor.h>
#include <espalier/weber_penn/simd/child_batch.h>

namespace espalier {

/// What children get from their parents, by row of WaitingChildren.
struct TwigBatchParents {
  template <typename T>
  using Column = WaitingChildren::Column<T>;
  alignas(64) Column<float> length_m, child_max, radius_m;
  Column<RandomKey> key;
  Column<Tree> tree;
  Column<std::int32_t> index, path_length;
};

/// Child stems in place, by row of WaitingChildren: where they start, their frames and sizes.
struct MadeStems {
  WaitingChildren::Columns3 position, forward, right;
  alignas(64) WaitingChildren::Column<float> length_m, radius_m;
};

class TwigBatch : public ChildBatch {
 public:
  /// Made stems go to the end of `stems`.
  TwigBatch(const WeberPennParameters& parameters, const GrowthSettings& settings, ChildBatchMemory& memory,
            std::vector<GrowingStem>& stems)
      : ChildBatch(ChildPlacer::Bears::stems, parameters, memory), settings_(settings), stems_(stems) {
    if (parameters.prune_ratio > 0 && settings.prune_to == nullptr) floor_.emplace(parameters);
  }

  /// Whether children of these stems can be made in batches: not in fans, on helices, on trunks, or where the
  /// stem swells periodically.
  static bool supports(const GrowingStem& parent, const WeberPennParameters& parameters);

  /// The place in the plant of the stem whose children are added next.
  void set_parent(std::int32_t index) { parent_index_ = index; }

  void flush() override;

 private:
  GrowingStem& add_made(std::size_t row);
  bool surely_fits(const GrowingStem& stem) const;

  float growth(const GrowingStem&, float grown_fraction) const override { return grown_fraction; }
  void note(const GrowingStem& stem, int first_row, int count) override;

  const GrowthSettings& settings_;
  std::vector<GrowingStem>& stems_;
  std::optional<EnvelopeFloor> floor_;  ///< where the parametric envelope prunes
  std::int32_t parent_index_ = -1;
  int parent_level_ = 0;
  TwigBatchParents parents_;
  MadeStems made_;
};

}  // namespace espalier
