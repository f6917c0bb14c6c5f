// Masks from pictures: what is above a threshold, and the outermost ring.
#pragma once
#include <espalier/image/masks/mask.h>
#include <espalier/image/separation/color_field.h>

namespace espalier {

inline Mask above(const Channel& channel, float threshold) {
  Mask mask(channel.width_px, channel.height_px);
  for (int y = 0; y < channel.height_px; ++y)
    for (int x = 0; x < channel.width_px; ++x) mask.set(x, y, channel.at(x, y) > threshold);
  return mask;
}

/// Calls visit(x, y) for each pixel of the outermost ring once.
template <typename Visit>
void visit_border(int width_px, int height_px, Visit visit) {
  for (int x = 0; x < width_px; ++x) {
    visit(x, 0);
    visit(x, height_px - 1);
  }
  for (int y = 1; y < height_px - 1; ++y) {
    visit(0, y);
    visit(width_px - 1, y);
  }
}

}  // namespace espalier
