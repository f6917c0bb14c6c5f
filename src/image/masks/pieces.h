// The connected pieces of a mask, as runs of pixels, with what tells them apart.
#pragma once
#include <cstddef>
#include <vector>

#include <espalier/image/masks/mask.h>
#include <espalier/image/masks/mask_box.h>

namespace espalier {

struct PieceRun {
  int y, begin, end;  ///< columns [begin, end)
};

struct MaskPiece {
  MaskBox box;
  std::size_t area_px = 0;
  std::vector<PieceRun> runs;
};

enum class Connectivity { four, eight };

/// The largest first; of equal ones the upper, then the left.
std::vector<MaskPiece> pieces_of(const Mask& mask, Connectivity connectivity = Connectivity::eight);

void set_pixels(const MaskPiece& piece, Mask& mask);

}  // namespace espalier
