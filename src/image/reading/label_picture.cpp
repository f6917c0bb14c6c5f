#include <espalier/image/reading/label_picture.h>

namespace espalier {

Picture label_picture(const Mask& tree, const PlantLabels& labels) {
  Picture picture(tree.width_px(), tree.height_px(), {255, 255, 255});
  for (int y = 0; y < tree.height_px(); ++y)
    for (int x = 0; x < tree.width_px(); ++x) {
      if (!tree.get(x, y)) continue;
      Rgb& pixel = picture.at(x, y);
      pixel = kDoubtColor;
      if (!labels.are_known()) continue;
      if (labels.leaf.get(x, y)) pixel = kLeafColor;
      if (labels.wood.get(x, y)) pixel = kWoodColor;
    }
  return picture;
}

}  // namespace espalier
