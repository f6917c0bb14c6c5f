// Random masks for property tests: tree-like clutter and noise of any size, odd widths included.
#pragma once
#include <rapidcheck.h>

#include <espalier/core/random.h>
#include <espalier/image/masks/mask.h>

namespace espalier::test {

/// `blobs` discs at random places of a mask; 0 gives an empty one.
inline Mask random_mask(int width_px, int height_px, int blobs, Seed seed) {
  Mask mask(width_px, height_px);
  const RandomKey key = root_key(seed);
  for (int blob = 0; blob < blobs; ++blob) {
    const float radius = 0.4f + uniform_unit(key, 0, blob) * static_cast<float>(width_px) / 8;
    const float cx = uniform_unit(key, 1, blob) * static_cast<float>(width_px);
    const float cy = uniform_unit(key, 2, blob) * static_cast<float>(height_px);
    for (int y = 0; y < height_px; ++y)
      for (int x = 0; x < width_px; ++x) {
        const float dx = static_cast<float>(x) + 0.5f - cx, dy = static_cast<float>(y) + 0.5f - cy;
        if (dx * dx + dy * dy < radius * radius) mask.set(x, y);
      }
  }
  return mask;
}

struct MaskPair {
  Mask a, b;
};

/// Two masks of the same drawn size: each side 1..`max_side_px`, each mask possibly empty.
inline MaskPair draw_pair(int max_side_px) {
  const int width = *rc::gen::inRange(1, max_side_px + 1).as("width");
  const int height = *rc::gen::inRange(1, max_side_px + 1).as("height");
  const int blobs_a = *rc::gen::inRange(0, 12).as("blobs of a");
  const int blobs_b = *rc::gen::inRange(0, 12).as("blobs of b");
  const auto seed = *rc::gen::arbitrary<Seed>().as("seed");
  return {random_mask(width, height, blobs_a, seed), random_mask(width, height, blobs_b, seed + 1)};
}

inline Mask draw_mask(int max_side_px) { return draw_pair(max_side_px).a; }

inline bool is_subset(const Mask& a, const Mask& b) {
  for (std::size_t i = 0; i < a.words().size(); ++i)
    if (a.words()[i] & ~b.words()[i]) return false;
  return true;
}

}  // namespace espalier::test
