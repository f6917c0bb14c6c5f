// The sum of distances from a candidate, in vectors (Highway); counts are whole numbers, the same for all
// instruction sets. A mask is copied column by column of words (64 pixels wide), with a border of zero words
// all around: a word's eight neighbours are then at fixed distances, and a vector of rows is dilated without
// looking at borders. Pixels may grow beyond the picture within its last words: no shortest path of the
// octagonal distance needs them, and nothing counts there.
#undef HWY_TARGET_INCLUDE
// NOLINTNEXTLINE(bugprone-macro-parentheses): a name of a file
#define HWY_TARGET_INCLUDE <espalier/image/measures/distance_sum.cpp>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <cstdint>
#include <utility>
#include <vector>

#include <espalier/image/masks/bit_counter-inl.h>
#include <espalier/image/measures/distance.h>

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {
namespace {

using Words64 = hn::ScalableTag<std::uint64_t>;
using Vector = hn::Vec<Words64>;

/// Column 0, row 0 of the picture is word 1 of column 1; `stride` words from a column to the next.
struct Columns {
  std::vector<std::uint64_t> words;
  std::size_t count = 0, rows = 0, stride = 0;

  std::size_t first_of(std::size_t column) const { return (column + 1) * stride + 1; }

  /// Zero, for masks of this size.
  void reset(const Mask& mask) {
    const std::size_t lanes = hn::Lanes(Words64());
    count = static_cast<std::size_t>(mask.words_per_row());
    rows = static_cast<std::size_t>(mask.height_px());
    stride = (rows + lanes - 1) / lanes * lanes + 2;
    words.assign((count + 2) * stride, 0);
  }
  void copy(const Mask& mask) {
    reset(mask);
    for (std::size_t y = 0; y < rows; ++y)
      for (std::size_t i = 0; i < count; ++i) words[first_of(i) + y] = mask.row(static_cast<int>(y))[i];
  }
};

Vector load(const std::uint64_t* word) { return hn::LoadU(Words64(), word); }

/// The pixels of `middle` and those to their left and right.
Vector widened(Vector left, Vector middle, Vector right) {
  const Vector within = hn::Or3(middle, hn::ShiftLeft<1>(middle), hn::ShiftRight<1>(middle));
  return hn::Or3(within, hn::ShiftRight<63>(left), hn::ShiftLeft<63>(right));
}

struct Plus {
  static Vector dilate(const std::uint64_t* word, std::size_t stride) {
    const Vector sideways = widened(load(word - stride), load(word), load(word + stride));
    return hn::Or3(sideways, load(word - 1), load(word + 1));
  }
};

struct Square {
  static Vector three_rows(const std::uint64_t* word) {
    return hn::Or3(load(word - 1), load(word), load(word + 1));
  }
  static Vector dilate(const std::uint64_t* word, std::size_t stride) {
    return widened(three_rows(word - stride), three_rows(word), three_rows(word + stride));
  }
};

/// Dilates `reached` into `next`. Returns the number of pixels of `over` outside `reached`.
template <class Shape>
std::size_t dilate_and_count(const Columns& over, const Columns& reached, Columns& next) {
  const Words64 d;
  BitCounter<Words64> beyond;
  for (std::size_t column = 0; column < over.count; ++column) {
    const std::size_t first = over.first_of(column), end = first + over.rows;
    for (std::size_t i = first; i < end; i += hn::Lanes(d)) {
      const std::uint64_t* word = &reached.words[i];
      beyond.add(hn::AndNot(load(word), load(&over.words[i])));
      hn::StoreU(Shape::dilate(word, over.stride), d, &next.words[i]);
    }
  }
  return beyond.total();
}

// min(d, L) = the number of k in 0..L-1 with d > k. The last dilation is for nothing.
std::size_t sum_distances(const Mask& over_mask, const Mask& from, int limit_px) {
  static thread_local Columns over, reached, next;
  over.copy(over_mask);
  reached.copy(from);
  next.reset(from);
  std::size_t sum = 0;
  for (int k = 0; k < limit_px; ++k) {
    const std::size_t beyond = k % 2 == 0 ? dilate_and_count<Plus>(over, reached, next)
                                          : dilate_and_count<Square>(over, reached, next);
    if (beyond == 0) break;
    sum += beyond;
    std::swap(reached, next);
  }
  return sum;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace espalier {

HWY_EXPORT(sum_distances);

std::size_t sum_distances_px(const Mask& over, const Mask& from, int limit_px) {
  return HWY_DYNAMIC_DISPATCH(sum_distances)(over, from, limit_px);
}

}  // namespace espalier
#endif
