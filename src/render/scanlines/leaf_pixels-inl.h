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

#include <espalier/core/error.h>
#include <espalier/core/vector_math-inl.h>
#include <espalier/plant/leaf_half.h>
#include <espalier/render/scanlines/span.h>

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

  /// Two more edges are a band: they begin at one height and end at one height.
  bool has(std::size_t chain, std::size_t more) const {
    if (chain_ != chain || count_ != chain + more) return false;
    const Edge &last = edges_[count_ - 1], &other = edges_[count_ - std::min<std::size_t>(count_, 2)];
    return more != 2 || (last.y0 == other.y0 && last.y1 == other.y1);
  }

  /// LeafHalf::contains of each lane, for x of either sign. With kChain > 0: only where
  /// has(kChain, kMore).
  template <std::size_t kChain = 0, std::size_t kMore = 0>
  hn::Mask<Floats> contain(Vector x, Vector y) const {
    x = hn::Abs(x);
    auto inside = chain_contains<kChain>(x, y);
    if constexpr (kMore == 2) {
      const Edge &a = edges_[kChain], &b = edges_[kChain + 1];
      return hn::Xor(inside, hn::And(is_between(y, a, a), hn::Xor(is_left_of(a, x, y), is_left_of(b, x, y))));
    }
    const std::size_t chain = kChain == 0 ? chain_ : kChain, count = kChain == 0 ? count_ : kChain + kMore;
    for (std::size_t i = chain; i < count; ++i) {
      const Edge& edge = edges_[i];
      inside = hn::Xor(inside, hn::And(is_between(y, edge, edge), is_left_of(edge, x, y)));
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
  static hn::Mask<Floats> is_left_of(const Edge& edge, Vector x, Vector y) {
    return hn::Lt(x, hn::Add(of(edge.at_zero), hn::Mul(of(edge.slope), y)));
  }
  static hn::Mask<Floats> is_between(Vector y, const Edge& lowest, const Edge& highest) {
    return hn::And(hn::Ge(y, of(lowest.y0)), hn::Lt(y, of(highest.y1)));
  }
  /// y lies beside one edge of a chain at most.
  template <std::size_t kChain>
  hn::Mask<Floats> chain_contains(Vector x, Vector y) const {
    const std::size_t chain = kChain == 0 ? chain_ : kChain;
    Vector at_zero = of(edges_[0].at_zero), slope = of(edges_[0].slope);
    for (std::size_t i = 1; i < chain; ++i) {
      const auto is_above = hn::Ge(y, of(edges_[i].y0));
      at_zero = hn::IfThenElse(is_above, of(edges_[i].at_zero), at_zero);
      slope = hn::IfThenElse(is_above, of(edges_[i].slope), slope);
    }
    return hn::And(is_between(y, edges_[0], edges_[chain - 1]),
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

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#endif
