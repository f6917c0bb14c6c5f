// Labels as a picture to look at.
#pragma once
#include <espalier/image/pictures/picture.h>
#include <espalier/image/reading/plant_labels.h>

namespace espalier {

inline constexpr Rgb kLeafColor{0, 130, 60}, kWoodColor{130, 80, 40}, kDoubtColor{90, 90, 90};

/// The tree on white: leaves green, wood brown, what is in doubt grey. The labels are of the mask's size, or
/// unknown.
Picture label_picture(const Mask& tree, const PlantLabels& labels);

}  // namespace espalier
