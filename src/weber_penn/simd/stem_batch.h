// Stems of one level that neither split nor wind are walked several at a time, one a lane of the vector
// instructions: the same segments, bit for bit, as walk_stem gives (stem_walk.h). What is kept of a stem is
// a table with a row for each coordinate, an entry for each segment: a vector of places on the stem looks up
// the segments that they are on. Metres and degrees.
#pragma once
#include <array>
#include <span>
#include <vector>

#include <espalier/weber_penn/scalar/stem_walk.h>

namespace espalier {

/// The curve of one stem. Segment k runs from knot k to knot k + 1, at a third of its length from both along
/// the headings there: that of segment k - 1 (of segment 0 for the first) and its own.
struct StemCurve {
  static constexpr std::size_t kPoint = 0, kHeading = 3, kRight = 6, kRows = 9;  ///< rows, by axis

  int segments = 1;
  float segment_m = 0;
  std::size_t stride = 0;  ///< of rows; two vectors more than there are segments can be read and written
  const float* entries = nullptr;

  struct Rows3 {
    const float *x, *y, *z;
    Vec3 at(int entry) const { return {x[entry], y[entry], z[entry]}; }
  };
  /// Where the knots are.
  Rows3 point() const { return rows(kPoint, 0); }
  /// The heading of segments at their start, and at their end.
  Rows3 heading_at_start() const { return rows(kHeading, 0); }
  Rows3 heading() const { return rows(kHeading, 1); }
  /// The direction to the right of the heading at the end of segments.
  Rows3 right() const { return rows(kRight, 0); }

 private:
  Rows3 rows(std::size_t first, std::size_t entry) const {
    const float* const x = entries + first * stride + entry;
    return {x, x + stride, x + 2 * stride};
  }
};

class StemBatch {
 public:
  static constexpr int kMostStems = 8;

  /// Whether stems of this level can be walked in batches, unless overrides bend them.
  static bool supports(int level, const WeberPennParameters& parameters);

  /// Walks 1 to kMostStems stems of one level from their bases; the curves of the batch before are gone.
  void walk(std::span<const GrowingStem> stems, const WeberPennParameters& parameters);

  int segment_count() const { return curves_.front().segments; }
  const StemCurve& curve(std::size_t stem) const { return curves_[stem]; }

  /// Segment `index` of a stem as walk_stem yields it.
  Segment segment(std::size_t stem, int index) const;

 private:
  std::array<StemCurve, kMostStems> curves_;
  std::vector<float> entries_;
};

}  // namespace espalier
