// The target's side of every measure, made once. Immutable, so threads may share it.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include <espalier/image/masks/mask.h>

namespace espalier {

class PreparedTarget {
 public:
  explicit PreparedTarget(Mask target);

  const Mask& mask() const { return mask_; }
  const Mask& outline() const { return outline_; }
  const Mask& gaps() const { return gaps_; }  ///< of the outline, what the mask leaves free
  std::size_t set_pixels() const { return set_pixels_; }
  /// Set pixels in each 8×8 block, rows of blocks from the top.
  const std::vector<std::uint8_t>& block_counts() const { return block_counts_; }
  /// Bit j of min(d(p, target), K) for each pixel p.
  const std::vector<Mask>& distance_bits() const { return distance_bits_; }

 private:
  Mask mask_, outline_, gaps_;
  std::size_t set_pixels_ = 0;
  std::vector<std::uint8_t> block_counts_;
  std::vector<Mask> distance_bits_;
};

}  // namespace espalier
