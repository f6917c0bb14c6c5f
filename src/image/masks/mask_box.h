// The smallest box of pixels that holds all that is set in a mask.
#pragma once
#include <algorithm>
#include <cmath>

#include <espalier/image/masks/mask.h>

namespace espalier {

/// Ends exclusive.
struct MaskBox {
  int left = 0, right = 0, top = 0, bottom = 0;

  int width() const { return right - left; }
  int height() const { return bottom - top; }
  /// How many rows this share of its height is, rounded.
  int rows(double share) const { return static_cast<int>(std::lround(share * height())); }
  bool is_empty() const { return width() <= 0 || height() <= 0; }
};

MaskBox box_of(const Mask& mask);

/// The least box around both.
inline MaskBox joined(const MaskBox& a, const MaskBox& b) {
  return {std::min(a.left, b.left), std::max(a.right, b.right), std::min(a.top, b.top),
          std::max(a.bottom, b.bottom)};
}

}  // namespace espalier
