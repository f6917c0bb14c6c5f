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
#include <span>

#include "core/error.h"
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

/// The edges of a leaf's outline, each number in all lanes.
class LeafEdges {
 public:
  explicit LeafEdges(const LeafHalf& half) : count_(half.edges.size()), chain_(half.chain) {
    ESPALIER_CHECK_EQ(chain_ >= 1 && count_ <= kMost, true);
    for (std::size_t i = 0; i < count_; ++i) {
      const LeafHalf::Edge& edge = half.edges[i];
      edges_[i].y0.fill(edge.y0), edges_[i].y1.fill(edge.y1);
      edges_[i].at_zero.fill(edge.at_zero), edges_[i].slope.fill(edge.slope);
    }
  }

  /// LeafHalf::contains of each lane, for x of either sign.
  hn::Mask<Floats> contain(Vector x, Vector y) const {
    x = hn::Abs(x);
    auto inside = chain_contains(x, y);
    for (const Edge& edge : std::span(edges_).subspan(chain_, count_ - chain_)) {
      const Vector edge_x = hn::Add(of(edge.at_zero), hn::Mul(of(edge.slope), y));
      inside = hn::Xor(inside, hn::And(is_between(y, edge, edge), hn::Lt(x, edge_x)));
    }
    return inside;
  }

 private:
  static constexpr std::size_t kMost = 16;
  using Lanes = std::array<float, kMostLanes>;
  struct alignas(64) Edge {
    Lanes y0, y1, at_zero, slope;
  };

  static Vector of(const Lanes& lanes) { return hn::Load(Floats(), lanes.data()); }
  static hn::Mask<Floats> is_between(Vector y, const Edge& lowest, const Edge& highest) {
    return hn::And(hn::Ge(y, of(lowest.y0)), hn::Lt(y, of(highest.y1)));
  }
  /// y lies beside one edge of a chain at most.
  hn::Mask<Floats> chain_contains(Vector x, Vector y) const {
    Vector at_zero = of(edges_[0].at_zero), slope = of(edges_[0].slope);
    for (const Edge& edge : std::span(edges_).subspan(1, chain_ - 1)) {
      const auto is_above = hn::Ge(y, of(edge.y0));
      at_zero = hn::IfThenElse(is_above, of(edge.at_zero), at_zero);
      slope = hn::IfThenElse(is_above, of(edge.slope), slope);
    }
    return hn::And(is_between(y, edges_[0], edges_[chain_ - 1]),
                   hn::Lt(x, hn::Add(at_zero, hn::Mul(slope, y))));
  }

  std::size_t count_, chain_;
  std::array<Edge, kMost> edges_;
};

std::uint64_t bits_of(hn::Mask<Floats> lanes) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(Floats(), lanes, bits);
  return bits[0];
}

/// Which of the pixels from `column` on are inside, one bit a lane.
template <bool kPerspective>
std::uint64_t inside_bits(const LeafMap& map, const LeafEdges& edges, float column, float row) {
  const Floats d;
  const Vector columns = hn::Add(set(column), hn::Iota(d, 0.0f));
  const auto linear = [&](const float(&a)[3]) {
    return hn::Add(hn::Mul(columns, set(a[1])), set(a[0] + a[2] * row));
  };
  const Vector x = linear(map.x), y = linear(map.y);
  if (!kPerspective) return bits_of(edges.contain(x, y));
  const Vector w = linear(map.w);
  return bits_of(hn::And(hn::Gt(w, hn::Zero(d)), edges.contain(hn::Div(x, w), hn::Div(y, w))));
}

template <bool kPerspective>
void draw_leaf(const LeafMap& map, const LeafEdges& edges, const PixelRectangle& box, Mask& mask) {
  constexpr Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int row = box.begin_y; row < box.end_y; ++row) {
    std::uint64_t* words = mask.row(row).data();
    for (int column = box.begin_x; column < box.end_x; column += lanes) {
      const int end = std::min(column + lanes, box.end_x);
      if (is_span_set(words, column, end)) continue;
      const std::uint64_t inside =
          inside_bits<kPerspective>(map, edges, static_cast<float>(column - box.begin_x),
                                    static_cast<float>(row - box.begin_y)) &
          bit_run(0, end - column);
      set_bits(words, column, inside);
    }
  }
}

/// Some leaves of an orthographic picture: their maps and their rectangles.
struct LeafColumns {
  static constexpr std::size_t kMost = 64;
  template <typename T>
  using Column = std::array<T, kMost>;
  alignas(64) Column<float> x{}, x_by_column{}, x_by_row{}, y{}, y_by_column{}, y_by_row{};
  alignas(64) Column<std::int32_t> begin_x, end_x, begin_y, end_y;

  LeafMap map(std::size_t i) const {
    return {{x[i], x_by_column[i], x_by_row[i]}, {y[i], y_by_column[i], y_by_row[i]}, {1, 0, 0}};
  }
  PixelRectangle box(std::size_t i) const { return {begin_x[i], end_x[i], begin_y[i], end_y[i]}; }
};

/// Small leaves as tiles of 4 × 2 pixels, those that are all set already left out. Neither taking a leaf nor
/// drawing a tile has a branch that depends on the picture: crowns make those hard to predict.
class TileQueue {
 public:
  static constexpr int kWidestPx = 8;

  explicit TileQueue(Mask& mask)
      : words_(mask.words().data()), words_per_row_(mask.words_per_row()), last_row_(mask.height_px() - 1) {}

  /// The pixels not set yet of the first 4 × 4 pixels of the rectangles of leaves [at, at + lanes): bit
  /// 4·row + column of each number.
  void unset_of_first_pixels(const LeafColumns& leaves, std::size_t at, std::int32_t* unset) const {
    static_assert(std::endian::native == std::endian::little);
    const hn::RebindToSigned<Floats> di;
    const auto load = [&](const auto& column) { return hn::Load(di, &column[at]); };
    const int row_bytes = 8 * words_per_row_;
    const auto x = load(leaves.begin_x), y = load(leaves.begin_y), most = hn::Set(di, kWidth);
    const auto width = hn::Min(hn::Sub(load(leaves.end_x), x), most),
               height = hn::Min(hn::Sub(load(leaves.end_y), y), most);
    const auto byte = hn::Min(hn::ShiftRight<3>(x), hn::Set(di, row_bytes - 4)),
               shift = hn::Sub(x, hn::ShiftLeft<3>(byte));
    auto set = hn::Zero(di);
    for (int row = 0; row < 2 * kHeight; ++row) {
      const auto line = hn::Min(hn::Add(y, hn::Set(di, row)), hn::Set(di, last_row_));
      const auto offset = hn::Add(hn::Mul(line, hn::Set(di, row_bytes)), byte);
      const auto bits = hn::GatherOffset(di, reinterpret_cast<const std::int32_t*>(words_), offset);
      set = hn::Or(set, hn::ShiftLeftSame(hn::And(hn::Shr(bits, shift), hn::Set(di, 15)), kWidth * row));
    }
    const auto one = hn::Set(di, 1), rows = hn::Sub(hn::Shl(one, hn::ShiftLeft<2>(height)), one),
               columns = hn::Mul(hn::Sub(hn::Shl(one, width), one), hn::Set(di, 0x1111));
    hn::StoreU(hn::AndNot(set, hn::And(rows, columns)), di, unset);
  }

  /// Takes leaf i, whose rectangle is at most kWidestPx on a side, or empty; `unset` as above.
  void add(const PixelRectangle& box, std::int32_t unset, std::size_t i) {
    append(i, 0, 0, unset & 255);
    append(i, 0, kHeight, unset >> 8);
    const int width = box.end_x - box.begin_x, height = box.end_y - box.begin_y;
    if (std::max(width, height) <= kWidth) return;
    for (int row = 0; row < height; row += kHeight)
      for (int column = row < 2 * kHeight ? kWidth : 0; column < width; column += kWidth)
        append(i, column, row, bits_inside(width - column) & (height - row > 1 ? 0xff : 0xf));
  }

  /// Sets the pixels of all tiles that are inside of their leaves, and empties the queue.
  void draw(const LeafColumns& leaves, const LeafEdges& edges) {
    for (const Tile& tile : std::span(tiles_).first(size_)) {
      const std::uint32_t inside = inside_bits(leaves, tile, edges) & tile.unset;
      const int x = leaves.begin_x[tile.leaf] + tile.column, y = leaves.begin_y[tile.leaf] + tile.row;
      std::uint64_t* const row = words_ + std::ptrdiff_t{y} * words_per_row_;
      set_bits(row, x, inside & 15);
      set_bits(tile.unset > 15 ? row + words_per_row_ : row, x, inside >> kWidth);
    }
    size_ = 0;
  }

 private:
  static constexpr int kWidth = 4, kHeight = 2;

  /// Its first pixel, counted from that of the leaf's rectangle; bit 4·row + column for each pixel.
  struct Tile {
    std::uint8_t leaf, column, row, unset;
  };

  /// Of both rows of a tile, the first `width` pixels.
  static int bits_inside(int width) { return 0x11 * ((1 << std::min(width, kWidth)) - 1); }

  void append(std::size_t leaf, int column, int row, int unset) {
    tiles_[size_] = {static_cast<std::uint8_t>(leaf), static_cast<std::uint8_t>(column),
                     static_cast<std::uint8_t>(row), static_cast<std::uint8_t>(unset)};
    size_ += unset != 0;
  }

  static std::uint32_t inside_bits(const LeafColumns& leaves, const Tile& tile, const LeafEdges& edges) {
    alignas(64) static constexpr float kColumns[][kMostLanes] = {{0, 1, 2, 3, 0, 1, 2, 3},
                                                                 {4, 5, 6, 7, 4, 5, 6, 7}};
    alignas(64) static constexpr float kRows[][kMostLanes] = {{0, 0, 0, 0, 1, 1, 1, 1},
                                                              {2, 2, 2, 2, 3, 3, 3, 3},
                                                              {4, 4, 4, 4, 5, 5, 5, 5},
                                                              {6, 6, 6, 6, 7, 7, 7, 7}};
    const std::size_t i = tile.leaf;
    std::uint32_t bits = 0;
    for (std::size_t pixel = 0; pixel < kMostLanes; pixel += hn::Lanes(Floats())) {
      const Vector column = hn::Load(Floats(), kColumns[tile.column / kWidth] + pixel),
                   row = hn::Load(Floats(), kRows[tile.row / kHeight] + pixel);
      const Vector x = hn::Add(hn::Add(set(leaves.x[i]), hn::Mul(column, set(leaves.x_by_column[i]))),
                               hn::Mul(row, set(leaves.x_by_row[i])));
      const Vector y = hn::Add(hn::Add(set(leaves.y[i]), hn::Mul(column, set(leaves.y_by_column[i]))),
                               hn::Mul(row, set(leaves.y_by_row[i])));
      bits |= static_cast<std::uint32_t>(bits_of(edges.contain(x, y))) << pixel;
    }
    return bits;
  }

  std::uint64_t* words_;
  int words_per_row_, last_row_;
  std::size_t size_ = 0;
  std::array<Tile, LeafColumns::kMost * kWidestPx * kWidestPx / (kWidth * kHeight) + 1> tiles_;
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#endif
