// Cones of an orthographic picture, one a lane: their four sides become bounds on x along scan lines. Of
// short cones, which most of a tree's are, a scan line of each is drawn at once; a long one is drawn by
// itself, a vector of scan lines at a time. For files that Highway compiles once per instruction set.
#if defined(ESPALIER_RENDER_CONE_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ESPALIER_RENDER_CONE_LANES_INL_H
#undef ESPALIER_RENDER_CONE_LANES_INL_H
#else
#define ESPALIER_RENDER_CONE_LANES_INL_H
#endif

#include <algorithm>
#include <array>
#include <bit>

#include <espalier/render/scanlines/run_queue-inl.h>
#include <espalier/render/scanlines/scanline_cone.h>
#include <espalier/render/scanlines/span.h>
#include <espalier/render/scanlines/span_lanes-inl.h>

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {
namespace {

constexpr float kFarPx = 1e9f;

struct Line {
  Vector at_zero, by_row;  ///< x along scan lines

  Vector at(Vector y) const { return hn::Add(at_zero, hn::Mul(by_row, y)); }
};

struct Limit {
  Line line;
  hn::Mask<Floats> is_upper;
};

Line choose(hn::Mask<Floats> where, const Line& a, const Line& b) {
  return {hn::IfThenElse(where, a.at_zero, b.at_zero), hn::IfThenElse(where, a.by_row, b.by_row)};
}

/// Points of stems in the picture, and their radii there.
struct StemPoints {
  Vector x, y, depth, radius;
};

Vector length2(Vector x, Vector y) { return hn::Sqrt(hn::Add(hn::Mul(x, x), hn::Mul(y, y))); }

/// The half planes of draw_cone [scanline_cone.cpp], each as the bound it sets on x; rows count from y0.
struct ConeBounds {
  Line lower[3], upper[3];

  ConeBounds(const StemPoints& from, const StemPoints& to, Vector ux, Vector uy, Vector axis) {
    const Floats d;
    const Vector radius = from.radius, slope = hn::Div(hn::Sub(to.radius, radius), axis);
    // c·x <= e + f·y, an upper bound where c > 0
    const auto limit = [&](Vector c, Vector e, Vector f) {
      const Vector inverse = hn::Div(set(1), hn::CopySign(hn::Max(hn::Abs(c), set(1e-12f)), c));
      return Limit{{hn::Add(from.x, hn::Mul(e, inverse)), hn::Mul(f, inverse)}, hn::Gt(inverse, hn::Zero(d))};
    };
    const Line none_low{set(-kFarPx), hn::Zero(d)}, none_high{set(kFarPx), hn::Zero(d)};
    const Limit foot = limit(hn::Neg(ux), hn::Zero(d), uy), tip = limit(ux, axis, hn::Neg(uy));
    lower[0] = choose(foot.is_upper, tip.line, foot.line);
    upper[0] = choose(foot.is_upper, foot.line, tip.line);
    const Vector leaning = hn::Mul(slope, ux), rising = hn::Mul(slope, uy);
    const Limit left = limit(hn::Sub(hn::Neg(uy), leaning), radius, hn::Sub(rising, ux));
    const Limit right = limit(hn::Sub(uy, leaning), radius, hn::Add(rising, ux));
    lower[1] = choose(left.is_upper, none_low, left.line);
    upper[1] = choose(left.is_upper, left.line, none_high);
    lower[2] = choose(right.is_upper, none_low, right.line);
    upper[2] = choose(right.is_upper, right.line, none_high);
  }

  Vector low(Vector y) const { return hn::Max(hn::Max(lower[0].at(y), lower[1].at(y)), lower[2].at(y)); }
  Vector high(Vector y) const { return hn::Min(hn::Min(upper[0].at(y), upper[1].at(y)), upper[2].at(y)); }

  /// The bounds of one lane, in all lanes.
  ConeBounds of(std::size_t lane) const {
    ConeBounds one = *this;
    for (Line* line :
         {&one.lower[0], &one.lower[1], &one.lower[2], &one.upper[0], &one.upper[1], &one.upper[2]})
      *line = {of_lane(line->at_zero, lane), of_lane(line->by_row, lane)};
    return one;
  }

  static Vector of_lane(Vector v, std::size_t lane) {
    alignas(64) std::array<float, kMostLanes> lanes;
    hn::Store(v, Floats(), lanes.data());
    return set(lanes[lane]);
  }
};

/// One cone, a vector of its scan lines at a time.
void draw_rows(const ConeBounds& bounds, float y0, int begin_row, int end_row, Mask& mask) {
  const Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  alignas(32) std::array<std::int32_t, kMostLanes> begins, ends;
  std::uint64_t* words = mask.row(begin_row).data();
  for (int row = begin_row; row < end_row; row += lanes) {
    const Vector y = hn::Add(set(static_cast<float>(row) + 0.5f - y0), hn::Iota(d, 0.0f));
    store_run(bounds.low(y), bounds.high(y), mask.width_px(), begins.data(), ends.data());
    const auto count = static_cast<std::size_t>(std::min(lanes, end_row - row));
    for (std::size_t j = 0; j < count; ++j, words += mask.words_per_row())
      set_short_span(words, begins[j], ends[j]);
  }
}

/// What is drawn of a vector of cones.
class ConeLanes {
 public:
  /// Cones from one point to the next; `is_cone` is not 0 where there is one.
  ConeLanes(const StemPoints& from, const StemPoints& to, IntegerLanes is_cone, const Mask& mask)
      : from_(from),
        to_(to),
        dx_(hn::Sub(to.x, from.x)),
        axis_(hn::Max(length2(dx_, hn::Sub(to.y, from.y)), set(1e-6f))),
        inverse_axis_(hn::Div(set(1), axis_)),
        ux_(hn::Mul(dx_, inverse_axis_)),
        is_cone_(is_cone) {
    const Vector reach0 = hn::Mul(from.radius, hn::Abs(ux_)), reach1 = hn::Mul(to.radius, hn::Abs(ux_));
    rows_ = run_lanes(hn::Min(hn::Sub(from.y, reach0), hn::Sub(to.y, reach1)),
                      hn::Max(hn::Add(from.y, reach0), hn::Add(to.y, reach1)), mask.height_px());
  }

  /// Short cones leave runs in the queue, the others are drawn.
  void draw(RunQueue& runs, Mask& mask) const {
    const Integers di;
    const auto count = hn::And(hn::Sub(rows_.end, rows_.begin), is_cone_);
    const IntegerLanes most = hn::MaxOfLanes(di, count);
    if (hn::GetLane(most) > 0) {
      const ConeBounds bounds(from_, to_, ux_, hn::Mul(hn::Sub(to_.y, from_.y), inverse_axis_), axis_);
      const Vector width = hn::Add(hn::Abs(dx_), hn::Add(from_.radius, to_.radius));
      const auto is_short = hn::And(hn::Lt(count, hn::Set(di, kMostShortRows + 1)),
                                    hn::RebindMask(di, hn::Lt(width, set(kWidestShortPx))));
      draw_short(bounds, hn::IfThenElseZero(is_short, count), mask.width_px(), runs);
      if (!hn::AllTrue(di, is_short)) draw_long(bounds, hn::IfThenZeroElse(is_short, count), mask);
    }
    draw_ends(mask);
  }

 private:
  static constexpr int kMostShortRows = 16;
  static constexpr float kWidestShortPx = 28;

  void draw_short(const ConeBounds& bounds, IntegerLanes count, int width_px, RunQueue& runs) const {
    const Integers di;
    const int most = hn::GetLane(hn::MaxOfLanes(di, count));
    const Vector first = hn::Sub(hn::Add(hn::ConvertTo(Floats(), rows_.begin), set(0.5f)), from_.y);
    for (int row = 0; row < most; ++row) {
      const Vector y = hn::Add(first, set(static_cast<float>(row)));
      const RunLanes run = run_lanes(bounds.low(y), bounds.high(y), width_px);
      const auto width = hn::IfThenElseZero(hn::Gt(count, hn::Set(di, row)), hn::Sub(run.end, run.begin));
      const auto bits = hn::Sub(hn::Shl(hn::Set(di, 1), width), hn::Set(di, 1));
      runs.add(hn::Add(rows_.begin, hn::Set(di, row)), run.begin, bits);
    }
  }

  void draw_long(const ConeBounds& bounds, IntegerLanes count, Mask& mask) const {
    const Integers di;
    alignas(64) std::array<std::int32_t, kMostLanes> begins, counts;
    alignas(64) std::array<float, kMostLanes> y0;
    hn::Store(rows_.begin, di, begins.data());
    hn::Store(count, di, counts.data());
    hn::Store(from_.y, Floats(), y0.data());
    for (std::size_t lane = 0; lane < hn::Lanes(di); ++lane)
      if (counts[lane] > 0)
        draw_rows(bounds.of(lane), y0[lane], begins[lane], begins[lane] + counts[lane], mask);
  }

  /// Where the discs at the ends show.
  void draw_ends(Mask& mask) const {
    const Floats d;
    const Vector depth = hn::Sub(to_.depth, from_.depth), thickest = hn::Max(from_.radius, to_.radius);
    const Vector tilt = hn::Div(hn::Abs(depth), hn::Max(length2(axis_, depth), set(1e-6f)));
    const auto shows = hn::And(hn::Gt(hn::Mul(thickest, tilt), set(kThinnestEllipsePx)),
                               hn::RebindMask(d, hn::Ne(is_cone_, hn::Zero(Integers()))));
    if (hn::AllFalse(d, shows)) return;
    alignas(64) std::array<std::array<float, kMostLanes>, 7> columns;
    std::size_t column = 0;
    for (const Vector v : {from_.x, from_.y, from_.radius, to_.x, to_.y, to_.radius, tilt})
      hn::Store(v, d, columns[column++].data());
    const auto& [x0, y0, r0, x1, y1, r1, tilts] = columns;
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, shows, bits);
    for (unsigned left = bits[0]; left != 0; left &= left - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(left));
      draw_cone_ends({x0[i], y0[i], r0[i]}, {x1[i], y1[i], r1[i]}, tilts[i], mask);
    }
  }

  StemPoints from_, to_;
  Vector dx_, axis_, inverse_axis_, ux_;
  IntegerLanes is_cone_;
  RunLanes rows_;
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#endif
