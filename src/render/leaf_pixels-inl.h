// Which pixels of a leaf's rectangle lie inside of its outline: of a large leaf a row at a time, of many
// small leaves together. For files that Highway compiles once per instruction set.
#if defined(ESPALIER_RENDER_LEAF_PIXELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ESPALIER_RENDER_LEAF_PIXELS_INL_H
#undef ESPALIER_RENDER_LEAF_PIXELS_INL_H
#else
#define ESPALIER_RENDER_LEAF_PIXELS_INL_H
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "core/vector_math-inl.h"
#include "plant/leaf_half.h"
#include "render/span.h"

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {
namespace {

/// x = (x[0] + x[1]·column + x[2]·row) / w, with columns and rows counted from the first pixel of the leaf's
/// rectangle; y likewise. In an orthographic picture w = 1. A leaf in front of a perspective camera has w >
/// 0.
struct LeafMap {
  float x[3], y[3], w[3];
};

/// Both functions: LeafHalf::contains of each lane; x is not negative.
hn::Mask<Floats> is_inside_edges(const LeafHalf& half, Vector x, Vector y) {
  auto inside = hn::FirstN(Floats(), 0);
  for (const LeafHalf::Edge& edge : half.edges) {
    const Vector from_start = hn::Sub(y, set(edge.y0));
    const Vector edge_x = hn::Add(set(edge.x0), hn::Mul(set(edge.slope), from_start));
    const auto beside = hn::And(hn::Ge(y, set(edge.y0)), hn::Lt(y, set(edge.y1)));
    inside = hn::Xor(inside, hn::And(beside, hn::Lt(x, edge_x)));
  }
  return inside;
}

/// Where the edges are a chain, y lies beside one of them at most.
hn::Mask<Floats> is_inside_chain(const LeafHalf& half, Vector x, Vector y) {
  const LeafHalf::Edge& lowest = half.edges.front();
  Vector x0 = set(lowest.x0), y0 = set(lowest.y0), slope = set(lowest.slope);
  for (std::size_t i = 1; i < half.edges.size(); ++i) {
    const LeafHalf::Edge& edge = half.edges[i];
    const auto is_above = hn::Ge(y, set(edge.y0));
    x0 = hn::IfThenElse(is_above, set(edge.x0), x0);
    y0 = hn::IfThenElse(is_above, set(edge.y0), y0);
    slope = hn::IfThenElse(is_above, set(edge.slope), slope);
  }
  const Vector edge_x = hn::Add(x0, hn::Mul(slope, hn::Sub(y, y0)));
  const auto beside = hn::And(hn::Ge(y, set(lowest.y0)), hn::Lt(y, set(half.edges.back().y1)));
  return hn::And(beside, hn::Lt(x, edge_x));
}

hn::Mask<Floats> is_inside(const LeafHalf& half, Vector x, Vector y) {
  return half.is_chain ? is_inside_chain(half, hn::Abs(x), y) : is_inside_edges(half, hn::Abs(x), y);
}

std::uint64_t bits_of(hn::Mask<Floats> lanes) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(Floats(), lanes, bits);
  return bits[0];
}

/// Which of the pixels from `column` on are inside, one bit a lane.
template <bool kPerspective>
std::uint64_t inside_bits(const LeafMap& map, const LeafHalf& half, float column, float row) {
  const Floats d;
  const Vector columns = hn::Add(set(column), hn::Iota(d, 0.0f));
  const auto linear = [&](const float(&a)[3]) {
    return hn::Add(hn::Mul(columns, set(a[1])), set(a[0] + a[2] * row));
  };
  const Vector x = linear(map.x), y = linear(map.y);
  if (!kPerspective) return bits_of(is_inside(half, x, y));
  const Vector w = linear(map.w);
  return bits_of(hn::And(hn::Gt(w, hn::Zero(d)), is_inside(half, hn::Div(x, w), hn::Div(y, w))));
}

template <bool kPerspective>
void draw_leaf(const LeafMap& map, const LeafHalf& half, const PixelRectangle& box, Mask& mask) {
  constexpr Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int row = box.begin_y; row < box.end_y; ++row) {
    std::uint64_t* words = mask.row(row).data();
    for (int column = box.begin_x; column < box.end_x; column += lanes) {
      const int end = std::min(column + lanes, box.end_x);
      if (is_span_set(words, column, end)) continue;
      const std::uint64_t inside =
          inside_bits<kPerspective>(map, half, static_cast<float>(column - box.begin_x),
                                    static_cast<float>(row - box.begin_y)) &
          bit_run(0, end - column);
      words[column >> 6] |= inside << (column & 63);
      if ((column & 63) + (end - column) > 64) words[(column >> 6) + 1] |= inside >> (64 - (column & 63));
    }
  }
}

/// Some leaves of an orthographic picture: their maps and their rectangles.
struct LeafColumns {
  static constexpr std::size_t kMost = 32;
  template <typename T>
  using Column = std::array<T, kMost>;
  alignas(64) Column<float> x{}, x_by_column{}, x_by_row{}, y{}, y_by_column{}, y_by_row{};
  alignas(64) Column<std::int32_t> begin_x, end_x, begin_y, end_y;

  LeafMap map(std::size_t i) const {
    return {{x[i], x_by_column[i], x_by_row[i]}, {y[i], y_by_column[i], y_by_row[i]}, {1, 0, 0}};
  }
  PixelRectangle box(std::size_t i) const { return {begin_x[i], end_x[i], begin_y[i], end_y[i]}; }
};

/// Pixels of small leaves that are not set yet, and the leaf that may set them. Entering them takes no branch
/// that a crown's leaves make hard to predict.
class PixelQueue {
 public:
  static constexpr int kWidestPx = 8;

  explicit PixelQueue(Mask& mask)
      : words_(mask.words().data()),
        row_bytes_(std::ptrdiff_t{8} * mask.words_per_row()),
        last_row_(mask.height_px() - 1) {}

  /// Takes leaf i, whose rectangle is at most kWidestPx on a side; it may be empty. `first_tile` is that of
  /// unset_in_first_tiles().
  void add(const PixelRectangle& box, std::int32_t first_tile, std::size_t i) {
    add_pixels(static_cast<std::uint32_t>(first_tile), 0, i);
    const int width = box.end_x - box.begin_x, height = box.end_y - box.begin_y;
    if (std::max(width, height) <= kTile) return;
    for (int row = 0; row < height; row += kTile)
      for (int column = row == 0 ? kTile : 0; column < width; column += kTile)
        add_tile(box, row, column, std::min(height - row, kTile), std::min(width - column, kTile), i);
  }

  /// The pixels not set yet of the first 4 × 4 pixels of the rectangles of leaves [at, at + lanes): bit
  /// 4·row + column of each number.
  void unset_in_first_tiles(const LeafColumns& leaves, std::size_t at, std::int32_t* unset) const {
    const hn::RebindToSigned<Floats> di;
    const auto load = [&](const auto& column) { return hn::Load(di, &column[at]); };
    const auto x = load(leaves.begin_x), y = load(leaves.begin_y), tile = hn::Set(di, kTile);
    const auto width = hn::Min(hn::Sub(load(leaves.end_x), x), tile),
               height = hn::Min(hn::Sub(load(leaves.end_y), y), tile);
    const auto byte = hn::Min(hn::ShiftRight<3>(x), hn::Set(di, static_cast<std::int32_t>(row_bytes_ - 4)));
    const auto shift = hn::Sub(x, hn::ShiftLeft<3>(byte));
    auto result = hn::Zero(di);
    for (int row = 0; row < kTile; ++row) {
      const auto line = hn::Min(hn::Add(y, hn::Set(di, row)), hn::Set(di, last_row_));
      const auto offset = hn::Add(hn::Mul(line, hn::Set(di, static_cast<std::int32_t>(row_bytes_))), byte);
      const auto bits = hn::GatherOffset(di, reinterpret_cast<const std::int32_t*>(words_), offset);
      const auto of_row = hn::And(hn::Shr(bits, shift), hn::Set(di, 15));
      result = hn::Or(result, hn::ShiftLeftSame(of_row, kTile * row));
    }
    const auto one = hn::Set(di, 1), rows = hn::Sub(hn::Shl(one, hn::ShiftLeft<2>(height)), one),
               columns = hn::Mul(hn::Sub(hn::Shl(one, width), one), hn::Set(di, 0x1111));
    hn::StoreU(hn::AndNot(result, hn::And(rows, columns)), di, unset);
  }

  /// Sets those pixels that are inside of their leaves, and empties the queue.
  void draw(const LeafColumns& leaves, const LeafHalf& half) {
    const hn::RebindToSigned<Floats> di;
    for (std::size_t first = 0; first < size_; first += hn::Lanes(di)) {
      const auto leaf = numbers_from(&leaf_[first]), pixel = numbers_from(&pixel_[first]);
      const Vector column = hn::ConvertTo(Floats(), hn::And(pixel, hn::Set(di, 7))),
                   row = hn::ConvertTo(Floats(), hn::ShiftRight<kRowShift>(pixel));
      const auto linear = [&](const auto& at_first, const auto& by_column, const auto& by_row) {
        const auto of_leaf = [&](const auto& numbers) {
          return hn::GatherIndex(Floats(), numbers.data(), leaf);
        };
        return hn::Add(hn::Add(of_leaf(at_first), hn::Mul(of_leaf(by_column), column)),
                       hn::Mul(of_leaf(by_row), row));
      };
      std::uint64_t inside = bits_of(is_inside(half, linear(leaves.x, leaves.x_by_column, leaves.x_by_row),
                                               linear(leaves.y, leaves.y_by_column, leaves.y_by_row)));
      if (size_ - first < hn::Lanes(di)) inside &= bit_run(0, static_cast<int>(size_ - first));
      for (; inside != 0; inside &= inside - 1)
        set_pixel(leaves, first + static_cast<std::size_t>(std::countr_zero(inside)));
    }
    size_ = 0;
  }

 private:
  static constexpr int kTile = 4, kRowShift = 3;  ///< a pixel is row << 3 | column

  /// Pixels of two rows of a tile, as many as bits are set, one a byte.
  static constexpr auto kPixelsOfBits = [] {
    std::array<std::uint64_t, 256> pixels{};
    for (unsigned bits = 0; bits < 256; ++bits)
      for (unsigned bit = 0, at = 0; bit < 8; ++bit)
        if ((bits >> bit & 1) != 0)
          pixels[bits] |= std::uint64_t{bit / kTile << kRowShift | bit % kTile} << 8 * at++;
    return pixels;
  }();

  static hn::Vec<hn::RebindToSigned<Floats>> numbers_from(const std::uint8_t* bytes) {
    const hn::RebindToSigned<Floats> di;
    return hn::PromoteTo(di, hn::LoadU(hn::Rebind<std::uint8_t, decltype(di)>(), bytes));
  }
  std::uint64_t bits_from(std::ptrdiff_t row, std::ptrdiff_t first_byte) const {
    static_assert(std::endian::native == std::endian::little);
    std::uint64_t bits;
    std::memcpy(&bits, reinterpret_cast<const char*>(words_) + row * row_bytes_ + first_byte, sizeof bits);
    return bits;
  }
  /// The tile of height × width pixels, each at most 4, at this row and column of the rectangle.
  void add_tile(const PixelRectangle& box, int row, int column, int height, int width, std::size_t i) {
    constexpr std::uint32_t kColumns[] = {0, 0x1111, 0x3333, 0x7777, 0xffff},
                            kRows[] = {0, 0xf, 0xff, 0xfff, 0xffff};
    const std::ptrdiff_t x = box.begin_x + column, byte = std::min(x >> 3, row_bytes_ - 8);
    std::uint32_t set = 0;
    for (int r = 0; r < kTile; ++r) {
      const std::uint64_t bits =
          bits_from(std::min(box.begin_y + row + r, last_row_), byte) >> (x - 8 * byte);
      set |= static_cast<std::uint32_t>(bits & 15) << 4 * r;
    }
    add_pixels(~set & kRows[height] & kColumns[width], row << kRowShift | column, i);
  }
  /// The pixels of a tile whose bits are set; `corner` is its first.
  void add_pixels(std::uint32_t bits, int corner, std::size_t i) {
    constexpr std::uint64_t kEachByte = 0x0101010101010101;
    const std::uint64_t leaf = i * kEachByte, upper = static_cast<std::uint64_t>(corner) * kEachByte;
    const std::uint64_t lower = upper + (2 << kRowShift) * kEachByte;
    append(kPixelsOfBits[bits & 255] + upper, leaf, bits & 255);
    append(kPixelsOfBits[bits >> 8] + lower, leaf, bits >> 8);
  }
  /// As many of eight pixels as bits are set.
  void append(std::uint64_t pixels, std::uint64_t leaf, std::uint32_t bits) {
    std::memcpy(&leaf_[size_], &leaf, sizeof leaf);
    std::memcpy(&pixel_[size_], &pixels, sizeof pixels);
    size_ += static_cast<std::size_t>(std::popcount(bits));
  }
  void set_pixel(const LeafColumns& leaves, std::size_t at) {
    const std::size_t i = leaf_[at];
    const int x = leaves.begin_x[i] + (pixel_[at] & 7), y = leaves.begin_y[i] + (pixel_[at] >> kRowShift);
    words_[std::ptrdiff_t{y} * (row_bytes_ / 8) + (x >> 6)] |= std::uint64_t{1} << (x & 63);
  }

  std::uint64_t* words_;
  std::ptrdiff_t row_bytes_;
  int last_row_;
  std::size_t size_ = 0;
  std::array<std::uint8_t, LeafColumns::kMost * kWidestPx * kWidestPx + 8> leaf_{}, pixel_{};
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#endif
