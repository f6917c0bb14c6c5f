#include <algorithm>

#include <espalier/image/masks/morphology.h>
#include <espalier/image/reading/room_to_grow.h>
#include <espalier/image/reading/roots.h>

namespace espalier {

namespace {

void add(const Mask& more, Mask& mask) {
  for (std::size_t w = 0; w < mask.words().size(); ++w) mask.words()[w] |= more.words()[w];
}

}  // namespace

Mask room_to_grow(const Mask& outline, const Mask& tree) {
  const int reach_px = std::max(1, std::max(outline.width_px(), outline.height_px()) / 64);
  const Mask wide = dilate_disc(erode_disc(outline, reach_px), reach_px);
  Mask thin = outline;
  for (std::size_t w = 0; w < thin.words().size(); ++w) thin.words()[w] &= ~wide.words()[w];
  Mask room = dilate_disc(thin, reach_px);
  add(outline, room);
  add(without_roots(tree), room);
  return room;
}

}  // namespace espalier
