#include "image/room_to_grow.h"

#include <algorithm>

#include "image/morphology.h"

namespace espalier {

Mask room_to_grow(const Mask& outline) {
  const int reach_px = std::max(1, std::max(outline.width_px(), outline.height_px()) / 64);
  const Mask wide = dilate_disc(erode_disc(outline, reach_px), reach_px);
  Mask thin = outline;
  for (std::size_t w = 0; w < thin.words().size(); ++w) thin.words()[w] &= ~wide.words()[w];
  Mask room = dilate_disc(thin, reach_px);
  for (std::size_t w = 0; w < room.words().size(); ++w) room.words()[w] |= outline.words()[w];
  return room;
}

}  // namespace espalier
