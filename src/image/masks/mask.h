// A binary mask, one bit a pixel. Row 0 is the top, the tree is set. Pixel centres at (i+0.5, j+0.5).
// Rows are padded with zero bits to whole 64-bit words, so that comparing masks is counting bits.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace espalier {

class Mask {
 public:
  Mask() = default;
  Mask(int width_px, int height_px) { reset(width_px, height_px); }

  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }
  int words_per_row() const { return words_per_row_; }

  bool get(int x, int y) const { return (word(x, y) >> (x & 63)) & 1u; }
  void set(int x, int y, bool value = true) {
    const std::uint64_t bit = std::uint64_t{1} << (x & 63);
    std::uint64_t& target = words_[static_cast<std::size_t>(y) * words_per_row_ + (x >> 6)];
    target = value ? target | bit : target & ~bit;
  }
  /// Bit x & 63 of word x >> 6 of a row is pixel x. Padding bits stay zero.
  std::span<std::uint64_t> row(int y) {
    return {words_.data() + static_cast<std::size_t>(y) * words_per_row_,
            static_cast<std::size_t>(words_per_row_)};
  }
  std::span<const std::uint64_t> row(int y) const {
    return {words_.data() + static_cast<std::size_t>(y) * words_per_row_,
            static_cast<std::size_t>(words_per_row_)};
  }
  std::span<const std::uint64_t> words() const { return words_; }
  std::span<std::uint64_t> words() { return words_; }
  /// All zero, of this size; memory is kept.
  void reset(int width_px, int height_px) {
    width_px_ = width_px;
    height_px_ = height_px;
    words_per_row_ = (width_px + 63) / 64;
    words_.assign(static_cast<std::size_t>(words_per_row_) * height_px, 0);
  }
  void clear() { std::fill(words_.begin(), words_.end(), 0); }

  bool operator==(const Mask&) const = default;

 private:
  std::uint64_t word(int x, int y) const {
    return words_[static_cast<std::size_t>(y) * words_per_row_ + (x >> 6)];
  }

  int width_px_ = 0, height_px_ = 0, words_per_row_ = 0;
  std::vector<std::uint64_t> words_;
};

/// Number of set pixels.
std::size_t area_px(const Mask& mask);

/// Number of pixels set in one mask and not in the other; both have the same size.
std::size_t differing_px(const Mask& a, const Mask& b);

/// What is set in `a` or in `b`, in both, or in `a` alone; all have the same size.
Mask either(Mask a, const Mask& b);
Mask both(Mask a, const Mask& b);
Mask without(Mask a, const Mask& b);

}  // namespace espalier
