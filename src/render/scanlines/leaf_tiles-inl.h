// Small leaves of an orthographic picture as tiles of 6 × 5 pixels, a tile a lane: those whose pixels are all
// set already are left out before their outlines are looked at. Nothing of this has a branch that depends on
// the pixels of one leaf: crowns make such branches hard to predict. For files that Highway compiles once per
// instruction set.
#if defined(ESPALIER_RENDER_LEAF_TILES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ESPALIER_RENDER_LEAF_TILES_INL_H
#undef ESPALIER_RENDER_LEAF_TILES_INL_H
#else
#define ESPALIER_RENDER_LEAF_TILES_INL_H
#endif

#include <algorithm>
#include <array>
#include <bit>

#include <espalier/render/scanlines/leaf_pixels-inl.h>
#include <espalier/render/scanlines/run_queue-inl.h>
#include <espalier/render/scanlines/span_lanes-inl.h>

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {
namespace {

/// A linear function of column and row.
struct LinearLanes {
  Vector at_first, by_column, by_row;

  Vector at(Vector column, Vector row) const {
    return hn::Add(hn::Add(at_first, hn::Mul(column, by_column)), hn::Mul(row, by_row));
  }
};

/// Leaves of an orthographic picture: their coordinates from the first pixel of their rectangles on.
struct LeafLanes {
  LinearLanes x, y;
  RunLanes columns, rows;  ///< their rectangles; empty where there is nothing to draw
};

class LeafTiles {
 public:
  static constexpr int kWidestPx = 12;

  LeafTiles(const LeafEdges& edges, Mask& mask)
      : edges_(edges),
        runs_(mask),
        words_(mask.words().data()),
        words_per_row_(mask.words_per_row()),
        last_row_(mask.height_px() - 1) {}

  /// Takes those of the leaves that are at most kWidestPx wide and high.
  HWY_INLINE void add(const LeafLanes& leaves) {
    const Integers di;
    const auto width = hn::Sub(leaves.columns.end, leaves.columns.begin),
               height = hn::Sub(leaves.rows.end, leaves.rows.begin);
    const auto is_small = hn::Lt(hn::Max(width, height), hn::Set(di, kWidestPx + 1));
    const auto across = hn::IfThenElseZero(is_small, width), down = hn::IfThenElseZero(is_small, height);
    const int widest = hn::GetLane(hn::MaxOfLanes(di, across)),
              highest = hn::GetLane(hn::MaxOfLanes(di, down));
    for (int row = 0; row < highest; row += kHeight) {
      const int rows = std::min(kHeight, highest - row);
      const auto left = hn::Sub(down, hn::Set(di, row));
      const SetPixels set = set_pixels(leaves, row, rows, widest > kWidth);
      add_tiles(leaves, 0, row, across, left, set.first);
      if (widest > kWidth)
        add_tiles(leaves, kWidth, row, hn::Sub(across, hn::Set(di, kWidth)), left, set.second);
    }
  }

  /// Sets the pixels of all tiles that are inside of their leaves, and empties the queue.
  void draw() {
    clear_row(size_);
    if (edges_.has(1, 0))
      draw_all<1, 0>();  // the outlines that there are
    else if (edges_.has(5, 0))
      draw_all<5, 0>();
    else if (edges_.has(5, 2))
      draw_all<5, 2>();
    else if (edges_.has(6, 0))
      draw_all<6, 0>();
    else
      draw_all<0, 0>();
    runs_.flush();
    size_ = 0;
  }

 private:
  static constexpr int kWidth = 6, kHeight = 5;  ///< at 256 px, most leaves are no larger
  static constexpr int kFirstColumn = 0x1041041, kRowBits = (1 << kWidth) - 1;
  static constexpr std::size_t kMost = 64;
  /// The place of the pixels of a tile.
  struct Place {
    float column, row;
    std::int32_t bit;
  };
  static constexpr std::array<Place, kWidth* kHeight> kPlaces = [] {
    std::array<Place, kWidth * kHeight> places{};
    std::size_t i = 0;
    for (int row = 0; row < kHeight; ++row)
      for (int column = 0; column < kWidth; ++column)
        places[i] = {static_cast<float>(column), static_cast<float>(row), std::int32_t{1} << i}, ++i;
    return places;
  }();
  template <typename T>
  using Column = std::array<T, kMost + 2 * kMostLanes>;
  struct LinearColumns {
    alignas(64) Column<float> at_first, by_column, by_row;
  };

  /// The tiles that begin at this pixel of their leaves, of which `right` and `down` pixels are left there.
  void add_tiles(const LeafLanes& leaves, int column, int row, IntegerLanes right, IntegerLanes down,
                 IntegerLanes set_already) {
    const Integers di;
    const Floats d;
    const auto x = hn::Add(leaves.columns.begin, hn::Set(di, column)),
               y = hn::Add(leaves.rows.begin, hn::Set(di, row));
    const auto unset = hn::AndNot(set_already, tile_pixels(clamped(right, kWidth), clamped(down, kHeight)));
    const Packing packing(hn::Ne(unset, hn::Zero(di)));
    const auto put = [&](const LinearLanes& from, LinearColumns& to) {
      const Vector first = from.at(set(static_cast<float>(column)), set(static_cast<float>(row)));
      packing.store(first, d, &to.at_first[size_]);
      packing.store(from.by_column, d, &to.by_column[size_]);
      packing.store(from.by_row, d, &to.by_row[size_]);
    };
    put(leaves.x, x_);
    put(leaves.y, y_);
    packing.store(x, di, &column_[size_]);
    packing.store(y, di, &row_[size_]);
    packing.store(unset, di, &unset_[size_]);
    size_ += packing.count();
    if (size_ >= kMost) draw();
  }

  static IntegerLanes clamped(IntegerLanes pixels, int most) {
    const Integers di;
    return hn::Min(hn::Max(pixels, hn::Zero(di)), hn::Set(di, most));
  }

  /// Bit kWidth·row + column of each number, of the first `width` × `height` pixels of a tile.
  static IntegerLanes tile_pixels(IntegerLanes width, IntegerLanes height) {
    const Integers di;
    const auto one = hn::Set(di, 1), rows = hn::Sub(hn::Shl(one, hn::Mul(height, hn::Set(di, kWidth))), one),
               columns = hn::Mul(hn::Sub(hn::Shl(one, width), one), hn::Set(di, kFirstColumn));
    return hn::And(rows, columns);
  }

  /// The pixels set already in the tiles at the left edges of the leaves, and in those right of them.
  struct SetPixels {
    IntegerLanes first, second;
  };

  /// `rows` rows from `row` on. The second tiles are looked at only where `has_second`: one gather serves
  /// both.
  SetPixels set_pixels(const LeafLanes& leaves, int row, int rows, bool has_second) const {
    static_assert(std::endian::native == std::endian::little && kWidestPx <= 2 * kWidth);
    const Integers di;
    const int row_bytes = 8 * words_per_row_;
    const auto x = leaves.columns.begin, y = hn::Add(leaves.rows.begin, hn::Set(di, row));
    const auto byte = hn::Min(hn::ShiftRight<3>(x), hn::Set(di, row_bytes - 4)),
               shift = hn::Min(hn::Sub(x, hn::ShiftLeft<3>(byte)), hn::Set(di, 31));
    SetPixels set{hn::Zero(di), hn::Zero(di)};
    const auto add = [&](IntegerLanes& to, IntegerLanes bits, int at) {
      to = hn::Or(to, hn::ShiftLeftSame(hn::And(bits, hn::Set(di, kRowBits)), kWidth * at));
    };
    const auto first_row = hn::Mul(y, hn::Set(di, row_bytes)), last_row = hn::Set(di, last_row_ * row_bytes);
    for (int i = 0; i < rows; ++i) {
      const auto offset = hn::Add(hn::Min(hn::Add(first_row, hn::Set(di, i * row_bytes)), last_row), byte);
      const auto bits =
          hn::Shr(hn::GatherOffset(di, reinterpret_cast<const std::int32_t*>(words_), offset), shift);
      add(set.first, bits, i);
      if (has_second) add(set.second, hn::ShiftRight<kWidth>(bits), i);
    }
    return set;
  }

  /// A vector of tiles without pixels, to fill up the last one.
  void clear_row(std::size_t at) {
    const Integers di;
    hn::StoreU(hn::Zero(di), di, &unset_[at]);
  }

  static LinearLanes load(const LinearColumns& columns, std::size_t at) {
    const Floats d;
    return {hn::Load(d, &columns.at_first[at]), hn::Load(d, &columns.by_column[at]),
            hn::Load(d, &columns.by_row[at])};
  }

  template <std::size_t kChain, std::size_t kMore>
  void draw_all() {
    for (std::size_t at = 0; at < size_; at += hn::Lanes(Floats())) draw_lanes<kChain, kMore>(at);
  }

  template <std::size_t kChain, std::size_t kMore>
  void draw_lanes(std::size_t at) {
    const Integers di;
    const LinearLanes x = load(x_, at), y = load(y_, at);
    const auto unset = hn::Load(di, &unset_[at]);
    auto inside = hn::Zero(di);
    const unsigned unset_by_any = any_bits(at);
    for (unsigned left = unset_by_any; left != 0; left &= left - 1) {
      const auto pixel = static_cast<std::size_t>(std::countr_zero(left));
      const Vector column = set(kPlaces[pixel].column), row = set(kPlaces[pixel].row);
      const auto is_inside =
          hn::RebindMask(di, edges_.contain<kChain, kMore>(x.at(column, row), y.at(column, row)));
      inside = hn::Or(inside, hn::IfThenElseZero(is_inside, hn::Set(di, kPlaces[pixel].bit)));
    }
    auto bits = hn::And(inside, unset);
    auto line = hn::Load(di, &row_[at]);
    const auto first = hn::Load(di, &column_[at]);
    for (unsigned left = unset_by_any; left != 0; left >>= kWidth) {
      runs_.add(line, first, hn::And(bits, hn::Set(di, kRowBits)));
      bits = hn::ShiftRight<kWidth>(bits);
      line = hn::Add(line, hn::Set(di, 1));
    }
  }

  /// The pixels that any tile of a vector has not set yet.
  unsigned any_bits(std::size_t at) const {
    std::int32_t bits = 0;
    for (std::size_t lane = 0; lane < hn::Lanes(Integers()); ++lane) bits |= unset_[at + lane];
    return static_cast<unsigned>(bits);
  }

  const LeafEdges& edges_;
  RunQueue runs_;
  std::uint64_t* words_;
  int words_per_row_, last_row_;
  std::size_t size_ = 0;
  LinearColumns x_, y_;
  alignas(64) Column<std::int32_t> column_, row_, unset_;
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#endif
