// The bands of rows that summaries of a silhouette are made of.
#pragma once
#include <algorithm>

#include <espalier/image/masks/mask_box.h>

namespace espalier {

/// Bands of profiles, and of what takes more pixels to measure.
inline constexpr int kHeights = 16, kTiers = 4;

struct Band {
  int first = 0, end = 0;

  int rows() const { return end - first; }
};

/// The rows of one of `count` bands from the top, at least one.
inline Band band_of(const MaskBox& box, int band, int count) {
  const int first = box.top + box.height() * band / count;
  return {first, std::max(first + 1, box.top + box.height() * (band + 1) / count)};
}

}  // namespace espalier
