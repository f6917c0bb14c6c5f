// Runs of pixels in a row of a mask: what a scan line leaves behind.
#pragma once
#include <algorithm>
#include <cstdint>

#include <espalier/image/masks/mask.h>
#include <espalier/render/pixel_rectangle.h>

namespace espalier {

/// Bits [begin, end) of one word; 0 <= begin < end <= 64.
inline std::uint64_t bit_run(int begin, int end) {
  return (~std::uint64_t{0} << begin) & (~std::uint64_t{0} >> (64 - end));
}

/// Sets pixels [begin, end) of a row; 0 <= begin < end <= its width.
inline void set_span(std::uint64_t* row, int begin, int end) {
  int word = begin >> 6;
  const int last = (end - 1) >> 6;
  for (begin &= 63; word < last; ++word, begin = 0) row[word] |= bit_run(begin, 64);
  row[word] |= bit_run(begin, ((end - 1) & 63) + 1);
}

/// Sets pixels x, x + 1, … of a row where `bits` has ones, from its lowest bit on. Whole words are written: a
/// processor then hands them from one shape to the next at once.
inline void set_bits(std::uint64_t* row, int x, std::uint64_t bits) {
  const int word = x >> 6, shift = x & 63;
  row[word] |= bits << shift;
  if (const std::uint64_t beyond = bits >> 1 >> (63 - shift); beyond != 0) row[word + 1] |= beyond;
}

/// Sets pixels [begin, end) of a row, which may be none: quicker than set_span for up to 63 pixels.
inline void set_short_span(std::uint64_t* row, int begin, int end) {
  if (end - begin < 64)
    set_bits(row, begin, (std::uint64_t{1} << (end - begin)) - 1);
  else
    set_span(row, begin, end);
}

/// True where pixels [begin, end) of a row are all set.
inline bool is_span_set(const std::uint64_t* row, int begin, int end) {
  int word = begin >> 6;
  const int last = (end - 1) >> 6;
  for (begin &= 63; word < last; ++word, begin = 0)
    if ((~row[word] & bit_run(begin, 64)) != 0) return false;
  return (~row[word] & bit_run(begin, ((end - 1) & 63) + 1)) == 0;
}

/// The pixels of [0, size) whose centres i + 0.5 lie in [low, high].
struct PixelRun {
  int begin, end;
};
inline PixelRun centres_between(float low, float high, int size) {
  const float first = std::max(low - 0.5f, 0.0f), limit = static_cast<float>(size);
  if (!(first < limit) || !(high >= 0.5f)) return {0, 0};
  const int floor_of_first = static_cast<int>(first);
  return {floor_of_first + (static_cast<float>(floor_of_first) < first),
          static_cast<int>(std::min(high + 0.5f, limit))};
}

/// True where all pixels of a box that is not empty are set: what falls there need not be drawn.
inline bool is_covered(const Mask& mask, const PixelRectangle& box) {
  for (int row = box.begin_y; row < box.end_y; ++row)
    if (!is_span_set(mask.row(row).data(), box.begin_x, box.end_x)) return false;
  return true;
}

}  // namespace espalier
