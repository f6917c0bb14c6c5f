// Stems of one level that neither split nor wind are walked several at a time, one a lane of the vector
// instructions: the same segments, bit for bit, as walk_stem gives (stem_walk.h). Metres and degrees.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "weber_penn/stem_walk.h"

namespace espalier {

class StemBatch {
 public:
  static constexpr int kMostStems = 8;

  /// Whether stems of this level can be walked in batches, unless overrides bend them.
  static bool takes(int level, const WeberPennParameters& parameters);

  /// Walks 1 to kMostStems stems of one level from their bases; the segments of the batch before are gone.
  void walk(std::span<const GrowingStem> stems, const WeberPennParameters& parameters);

  std::span<const Segment> segments(std::size_t stem) const {
    return {segments_.data() + stem * per_stem_, per_stem_};
  }

 private:
  std::size_t per_stem_ = 0;
  std::vector<Segment> segments_;
};

}  // namespace espalier
