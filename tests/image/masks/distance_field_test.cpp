// Exact distances against a search over all pixels.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include <espalier/image/masks/distance_field.h>

namespace espalier {
namespace {

float nearest_unset_px(const Mask& mask, int x, int y) {
  float nearest = 1e9f;
  for (int v = -1; v <= mask.height_px(); ++v)
    for (int u = -1; u <= mask.width_px(); ++u) {
      const bool outside = u < 0 || v < 0 || u == mask.width_px() || v == mask.height_px();
      if (outside || !mask.get(u, v))
        nearest = std::min(nearest, std::hypot(static_cast<float>(u - x), static_cast<float>(v - y)));
    }
  return nearest;
}

RC_GTEST_PROP(DistanceField, IsTheDistanceToTheNearestUnsetPixel, ()) {
  Mask mask(*rc::gen::inRange(1, 20), *rc::gen::inRange(1, 20));
  const int holes = *rc::gen::inRange(0, 6);
  for (int y = 0; y < mask.height_px(); ++y)
    for (int x = 0; x < mask.width_px(); ++x) mask.set(x, y);
  for (int i = 0; i < holes; ++i)
    mask.set(*rc::gen::inRange(0, mask.width_px()), *rc::gen::inRange(0, mask.height_px()), false);
  const std::vector<float> distances = distances_to_unset_px(mask);
  for (int y = 0; y < mask.height_px(); ++y)
    for (int x = 0; x < mask.width_px(); ++x)
      RC_ASSERT(std::fabs(distances[static_cast<std::size_t>(y * mask.width_px() + x)] -
                          nearest_unset_px(mask, x, y)) < 1e-4f);
}

}  // namespace
}  // namespace espalier
