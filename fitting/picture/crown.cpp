#include <algorithm>
#include <utility>

#include <espalier/fitting/picture/crown.h>
#include <espalier/image/masks/mask_box.h>

namespace espalier {

Mask crown_of(const Mask& mask, const PictureReading& reading, const PlantLabels& labels) {
  const MaskBox box = box_of(mask);
  const int end_row = box.bottom - box.rows(reading.crown_base);
  Mask crown(mask.width_px(), mask.height_px());
  for (int y = box.top; y < end_row; ++y) std::ranges::copy(mask.row(y), crown.row(y).begin());
  return labels.are_known() ? without(either(std::move(crown), labels.leaf), labels.wood) : crown;
}

}  // namespace espalier
