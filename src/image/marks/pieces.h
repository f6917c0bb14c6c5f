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

struct Piece {
  MaskBox box;
  std::size_t area_px = 0;
  std::vector<PieceRun> runs;
};

/// 8-connected, the largest first; of equal ones the upper, then the left.
std::vector<Piece> pieces_of(const Mask& mask);

}  // namespace espalier
