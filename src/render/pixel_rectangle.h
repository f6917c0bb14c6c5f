// Where a box of the world falls in a picture: rays outside of it need not be traced. Metres and pixels.
#pragma once
#include <espalier/render/camera.h>

namespace espalier {

/// Pixels [begin_x, end_x) × [begin_y, end_y).
struct PixelRectangle {
  int begin_x = 0, end_x = 0, begin_y = 0, end_y = 0;

  bool is_empty() const { return begin_x >= end_x || begin_y >= end_y; }
};

/// Contains all pixels of the camera whose centre's ray can meet `box`; all pixels where a perspective
/// camera stands beside or inside it.
PixelRectangle covered_pixels(const Camera& camera, const Bounds& box);

/// An orthographic camera moved along its rays to just before `box`: the same picture with the least
/// rounding, and nothing behind the camera is missed. A perspective camera as it is.
Camera moved_before(const Camera& camera, const Bounds& box);

}  // namespace espalier
