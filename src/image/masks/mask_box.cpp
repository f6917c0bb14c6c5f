#include <algorithm>

#include <espalier/image/masks/mask_box.h>

namespace espalier {

MaskBox box_of(const Mask& mask) {
  MaskBox box{mask.width_px(), 0, mask.height_px(), 0};
  for (int y = 0; y < mask.height_px(); ++y)
    for (int x = 0; x < mask.width_px(); ++x)
      if (mask.get(x, y))
        box = {std::min(box.left, x), std::max(box.right, x + 1), std::min(box.top, y),
               std::max(box.bottom, y + 1)};
  return box;
}

}  // namespace espalier
