// Cleans a mask: drops specks far from the tree, fills pinholes where asked. Areas in pixels.
#pragma once
#include <cstddef>
#include <vector>

#include <espalier/image/masks/mask.h>
#include <espalier/image/masks/pieces.h>

namespace espalier {

/// The pieces (connected sets of set pixels) of at least `min_area_px`.
Mask large_pieces(const Mask& mask, std::size_t min_area_px, Connectivity connectivity);

/// The 8-connected ones, each alone, the largest first.
std::vector<Mask> separate_pieces(const Mask& mask, std::size_t min_area_px);

/// Drops pieces (8-connected) under `speck_px` that no piece of that size has within a 64th of the
/// picture's larger side: loose leaves at the crown's rim stay.
Mask remove_specks(const Mask& mask, std::size_t speck_px);

/// Fills holes (4-connected, apart from the border) under `pinhole_px`.
Mask fill_pinholes(const Mask& mask, std::size_t pinhole_px);

/// The speck size used where none is given: a 20,000th of the picture, at least 4.
std::size_t default_speck_px(int width_px, int height_px);

}  // namespace espalier
