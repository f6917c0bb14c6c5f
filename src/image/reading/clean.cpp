#include <algorithm>
#include <vector>

#include <espalier/image/masks/morphology.h>
#include <espalier/image/reading/clean.h>

namespace espalier {

Mask large_pieces(const Mask& mask, std::size_t min_area_px, Connectivity connectivity) {
  Mask large(mask.width_px(), mask.height_px());
  for (const MaskPiece& piece : pieces_of(mask, connectivity))
    if (piece.area_px >= min_area_px) set_pixels(piece, large);
  return large;
}

std::vector<Mask> separate_pieces(const Mask& mask, std::size_t min_area_px) {
  std::vector<Mask> masks;
  for (const MaskPiece& piece : pieces_of(mask)) {
    if (piece.area_px < min_area_px) continue;
    masks.emplace_back(mask.width_px(), mask.height_px());
    set_pixels(piece, masks.back());
  }
  return masks;
}

Mask remove_specks(const Mask& mask, std::size_t speck_px) {
  const int reach_px = std::max(1, std::max(mask.width_px(), mask.height_px()) / 64);
  const Mask large = large_pieces(mask, speck_px, Connectivity::eight);
  return both(mask, dilate_disc(large, reach_px));
}

Mask fill_pinholes(const Mask& mask, std::size_t pinhole_px) {
  const Mask holes = both(fill_holes(mask), complement(mask));
  const Mask large = large_pieces(holes, pinhole_px, Connectivity::four);
  return either(mask, both(holes, complement(large)));
}

std::size_t default_speck_px(int width_px, int height_px) {
  return std::max<std::size_t>(4, static_cast<std::size_t>(width_px) * height_px / 20'000);
}

}  // namespace espalier
