#include <bit>
#include <utility>

#include <espalier/image/masks/bits.h>
#include <espalier/image/masks/morphology.h>
#include <espalier/image/measures/distance.h>

namespace espalier {

namespace {

/// Takes the pixels at distance <= k of a mask to those at distance <= k + 1. `spare` is memory only.
void grow_octagon(Mask& reached, int k, Mask& spare) {
  k % 2 == 0 ? dilate_plus(reached, spare) : dilate_square(reached, spare);
  std::swap(reached, spare);
}

/// Adds 1 to the bit-plane numbers of all pixels that `where` does not hold.
void increment_outside(const Mask& where, std::vector<Mask>& planes) {
  Mask carry = complement(where);
  for (Mask& plane : planes) {
    for (std::size_t i = 0; i < carry.words().size(); ++i) {
      const std::uint64_t old = plane.words()[i];
      plane.words()[i] = old ^ carry.words()[i];
      carry.words()[i] &= old;
    }
  }
}

}  // namespace

std::vector<Mask> distance_bit_planes(const Mask& from, int limit_px) {
  const auto plane_count = std::bit_width(static_cast<unsigned>(limit_px));
  std::vector<Mask> planes(plane_count, Mask(from.width_px(), from.height_px()));
  Mask reached = from, spare;
  for (int k = 0; k < limit_px; ++k) {
    increment_outside(reached, planes);
    grow_octagon(reached, k, spare);
  }
  return planes;
}

std::size_t sum_distances_px(const Mask& over, const std::vector<Mask>& bit_planes) {
  std::size_t sum = 0;
  for (std::size_t j = 0; j < bit_planes.size(); ++j)
    sum += count_and(over.words(), bit_planes[j].words()) << j;
  return sum;
}

}  // namespace espalier
