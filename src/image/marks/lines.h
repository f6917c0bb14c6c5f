// Long, straight, thin lines in a mask: the ground that a figure is drawn on, the frame around it.
#pragma once
#include <vector>

#include <espalier/image/masks/mask.h>
#include <espalier/image/masks/mask_box.h>

namespace espalier {

struct FoundLines {
  Mask pixels;
  std::vector<MaskBox> rows, columns;  ///< horizontal lines, and vertical ones
};

/// Horizontal lines from a quarter of the picture's width, and vertical ones from half of its height that end
/// at horizontal ones or at its edges: a thin trunk is no line. What is thicker where it crosses one is none
/// of it.
FoundLines find_lines(const Mask& mask);

}  // namespace espalier
