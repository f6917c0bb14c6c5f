// The runs of set pixels in a row of a mask.
#pragma once
#include <vector>

#include <espalier/image/masks/mask.h>

namespace espalier {

struct RowRun {
  int first = 0, last = -1;  ///< columns, both inside

  int width() const { return last - first + 1; }
  /// The middle between the outer edges of its pixels.
  float middle() const { return 0.5f * static_cast<float>(first + last + 1); }
  /// Whether, in rows one above the other, a pixel of one has a neighbour, also a diagonal one, in the other.
  bool touches(const RowRun& other) const { return first <= other.last + 1 && last >= other.first - 1; }
};

/// The runs of a row from left to right.
std::vector<RowRun> runs_of(const Mask& mask, int y);

/// The first of the widest; of no width in an empty row.
RowRun widest_run(const Mask& mask, int y);

/// Columns from the first to the last set pixel of the rows from `first` to before `end`; 0 where none is
/// set.
int extent_px(const Mask& mask, int first, int end);
inline int row_extent_px(const Mask& mask, int y) { return extent_px(mask, y, y + 1); }

}  // namespace espalier
