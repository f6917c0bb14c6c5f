// Where a leafy tree is to have leaves.
#pragma once
#include <espalier/fitting/picture/picture_reading.h>

namespace espalier {

/// The pixels of the mask above the height at which its crown begins, with what the labels call leaf and
/// without what they call wood.
Mask crown_of(const Mask& mask, const PictureReading& reading, const PlantLabels& labels);

}  // namespace espalier
