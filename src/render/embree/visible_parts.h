// Of which parts of a plant a picture shows how much: what the eye meets first in each pixel.
#pragma once
#include <cstddef>

#include <espalier/plant/plant.h>
#include <espalier/render/camera.h>

namespace espalier {

/// Pixels whose centre's ray meets wood first, or a leaf or blossom.
struct VisibleParts {
  std::size_t wood_px = 0, leaf_px = 0;

  /// Share of the plant's pixels that show wood; 0 where no pixel shows the plant.
  double wood_share() const {
    const std::size_t all = wood_px + leaf_px;
    return all == 0 ? 0 : static_cast<double>(wood_px) / static_cast<double>(all);
  }
};

VisibleParts count_visible_parts(const Plant& plant, const Camera& camera);

}  // namespace espalier
