#include <algorithm>

#include <espalier/fitting/picture/crown.h>
#include <espalier/image/masks/mask_box.h>

namespace espalier {

Mask crown_of(const Mask& mask, const PictureReading& reading, const PlantLabels& labels) {
  const MaskBox box = box_of(mask);
  const int end_row = box.bottom - box.rows(reading.crown_base);
  Mask crown(mask.width_px(), mask.height_px());
  for (int y = box.top; y < end_row; ++y) std::ranges::copy(mask.row(y), crown.row(y).begin());
  if (!labels.are_known()) return crown;
  for (std::size_t i = 0; i < crown.words().size(); ++i)
    crown.words()[i] = (crown.words()[i] | labels.leaf.words()[i]) & ~labels.wood.words()[i];
  return crown;
}

}  // namespace espalier
