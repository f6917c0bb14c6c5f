// Curves in the picture, cut into cones. A cubic curve cut into n equal parts deviates from its chords by at
// most max|B''|/(8n²), and at a joint that turns by an angle a the cones gap by radius·a/2. In an
// orthographic picture segments are prepared a vector of segments at a time, cut into points a vector of
// points at a time, and drawn a vector of cones at a time. All else takes the plain path, with the same
// formulas.
#undef HWY_TARGET_INCLUDE
// NOLINTNEXTLINE(bugprone-macro-parentheses): a name of a file
#define HWY_TARGET_INCLUDE <espalier/render/scanlines/scanline_stems.cpp>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <espalier/render/scanlines/cone_lanes-inl.h>
#include <espalier/render/scanlines/scanline_stems.h>
#include <espalier/render/scanlines/stem_curve.h>

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {
namespace {

constexpr int kBatch = 64;  ///< knots prepared at once

/// One number for each segment of a batch.
template <typename T>
using Column = std::array<T, kBatch + kMostLanes>;

/// Curves of segments, each control point a row of three columns: x, y, depth.
struct CurveColumns {
  alignas(64) std::array<std::array<Column<float>, 3>, 4> p;
  alignas(64) Column<float> r0, r1;
  Column<std::int32_t> cones;                           ///< 0 where nothing is drawn
  Column<std::int32_t> begin_x, end_x, begin_y, end_y;  ///< pixels they can meet

  PixelRectangle box(std::size_t i) const { return {begin_x[i], end_x[i], begin_y[i], end_y[i]}; }
};

/// Points of consecutive knots, or of their handles, in the picture.
struct PictureLanes {
  Vector x, y, depth;
};

class OrthographicLanes {
 public:
  explicit OrthographicLanes(const Camera& camera)
      : right_(camera.right * (1 / camera.metres_per_px)),
        down_(camera.up * (-1 / camera.metres_per_px)),
        forward_(camera.forward * (1 / camera.metres_per_px)),
        x_(camera.center_x_px - espalier::dot(camera.position_m, right_)),
        y_(camera.center_y_px - espalier::dot(camera.position_m, down_)) {}

  PictureLanes points(const Vec3* from) const {
    Vector3 v;
    hn::LoadInterleaved3(Floats(), &from->x, v.x, v.y, v.z);
    return {hn::Add(along(v, right_), set(x_)), hn::Add(along(v, down_), set(y_)), along(v, forward_)};
  }

 private:
  static Vector along(const Vector3& v, Vec3 direction) {
    return dot(v, {set(direction.x), set(direction.y), set(direction.z)});
  }
  Vec3 right_, down_, forward_;
  float x_, y_;
};

/// |a - 2b + c|.
Vector bend(const PictureLanes& a, const PictureLanes& b, const PictureLanes& c) {
  return length2(hn::Add(hn::Sub(a.x, hn::Add(b.x, b.x)), c.x),
                 hn::Add(hn::Sub(a.y, hn::Add(b.y, b.y)), c.y));
}

/// StemCurve::cones [stem_curve.cpp]; 0 for curves that are no numbers, or too large.
IntegerLanes cones_of(const PictureLanes& p0, const PictureLanes& p1, const PictureLanes& p2,
                      const PictureLanes& p3, Vector thickest) {
  const Vector most = hn::Max(bend(p0, p1, p2), bend(p1, p2, p3));
  const Vector for_chord = hn::Sqrt(hn::Mul(most, set(6 / (8 * kStemTolerancePx))));
  const Vector chord = length2(hn::Sub(p3.x, p0.x), hn::Sub(p3.y, p0.y));
  const Vector turn = hn::Min(hn::Div(hn::Mul(set(3), most), hn::Max(chord, set(1e-3f))), set(3));
  const Vector for_gaps = hn::Mul(hn::Mul(thickest, turn), set(1 / (2 * kStemTolerancePx)));
  const Vector cones = hn::IfThenElse(hn::Gt(thickest, set(1)), hn::Max(for_chord, for_gaps), for_chord);
  const Vector whole = hn::Min(hn::Max(hn::Ceil(cones), set(1)), set(kMostCones));
  return hn::ConvertTo(Integers(), hn::IfThenElseZero(hn::Lt(cones, set(kFarPx)), whole));
}

void store(Vector v, Column<float>& column, int at) {
  hn::StoreU(v, Floats(), &column[static_cast<std::size_t>(at)]);
}

/// Segments from knots [first + at, …) of the plant to their next knots.
void prepare(const Knots& knots, std::size_t first, int at, const OrthographicLanes& camera, float px_per_m,
             const Mask& mask, CurveColumns& curves) {
  const Integers di;
  const std::size_t k = first + static_cast<std::size_t>(at);
  const PictureLanes p[4] = {camera.points(&knots.point_m[k]), camera.points(&knots.handle_out_m[k]),
                             camera.points(&knots.handle_in_m[k + 1]), camera.points(&knots.point_m[k + 1])};
  for (std::size_t i = 0; i < 4; ++i) {
    store(p[i].x, curves.p[i][0], at);
    store(p[i].y, curves.p[i][1], at);
    store(p[i].depth, curves.p[i][2], at);
  }
  const auto radius_from = [&](std::size_t knot) {
    return hn::Mul(hn::Max(hn::LoadU(Floats(), &knots.radius_m[knot]), set(0)), set(px_per_m));
  };
  const Vector r0 = radius_from(k), r1 = radius_from(k + 1), reach = hn::Max(r0, r1);
  store(r0, curves.r0, at);
  store(r1, curves.r1, at);
  const auto run = [&](Vector a, Vector b, Vector c, Vector e, int size) {
    return run_lanes(hn::Sub(hn::Min(hn::Min(a, b), hn::Min(c, e)), reach),
                     hn::Add(hn::Max(hn::Max(a, b), hn::Max(c, e)), reach), size);
  };
  const RunLanes columns = run(p[0].x, p[1].x, p[2].x, p[3].x, mask.width_px()),
                 rows = run(p[0].y, p[1].y, p[2].y, p[3].y, mask.height_px());
  const auto i = static_cast<std::size_t>(at);
  hn::StoreU(columns.begin, di, &curves.begin_x[i]);
  hn::StoreU(columns.end, di, &curves.end_x[i]);
  hn::StoreU(rows.begin, di, &curves.begin_y[i]);
  hn::StoreU(rows.end, di, &curves.end_y[i]);
  const auto shows = hn::And(hn::Gt(columns.end, columns.begin), hn::Gt(rows.end, rows.begin));
  hn::StoreU(hn::IfThenElseZero(shows, cones_of(p[0], p[1], p[2], p[3], reach)), di, &curves.cones[i]);
}

/// Points along stems, which wait to be joined by cones.
class PointQueue {
 public:
  explicit PointQueue(Mask& mask) : mask_(mask), runs_(mask) {}

  /// Segment i of `curves` in this many cones. It goes on from the last one where that ends in its start.
  void add(const CurveColumns& curves, std::size_t i, int cones, bool goes_on) {
    if (count_ + cones + 2 > kMost) draw();
    count_ += !goes_on && count_ > 0;
    const Floats d;
    const Vector step = set(1 / static_cast<float>(cones)), r0 = set(curves.r0[i]), r1 = set(curves.r1[i]);
    for (int first = 0; first <= cones; first += static_cast<int>(hn::Lanes(d))) {
      const Vector t = hn::Mul(hn::ConvertTo(d, counted_from(first)), step);
      const PictureLanes point = on_curve(curves, i, t);
      const std::size_t at = static_cast<std::size_t>(count_) + static_cast<std::size_t>(first);
      hn::StoreU(point.x, d, &x_[at]);
      hn::StoreU(point.y, d, &y_[at]);
      hn::StoreU(point.depth, d, &depth_[at]);
      hn::StoreU(hn::Add(r0, hn::Mul(t, hn::Sub(r1, r0))), d, &radius_[at]);
      hn::StoreU(hn::Set(Integers(), -1), Integers(), &is_cone_[at]);
    }
    count_ += cones;
    hn::StoreU(hn::Zero(Integers()), Integers(), &is_cone_[static_cast<std::size_t>(count_)]);
  }

  /// Draws the cones between the points, and empties the queue.
  void draw() {
    for (std::size_t at = 0; at < static_cast<std::size_t>(count_); at += hn::Lanes(Floats()))
      ConeLanes(load(at), load(at + 1), hn::LoadU(Integers(), &is_cone_[at]), mask_).draw(runs_, mask_);
    runs_.flush();
    count_ = 0;
  }

 private:
  static constexpr int kMost = 256;
  template <typename T>
  using Points = std::array<T, kMost + 2 * kMostLanes>;

  StemPoints load(std::size_t at) const {
    const Floats d;
    return {hn::LoadU(d, &x_[at]), hn::LoadU(d, &y_[at]), hn::LoadU(d, &depth_[at]),
            hn::LoadU(d, &radius_[at])};
  }

  /// The points of curve i at t.
  static PictureLanes on_curve(const CurveColumns& curves, std::size_t i, Vector t) {
    const Vector u = hn::Sub(set(1), t), uu = hn::Mul(u, u), tt = hn::Mul(t, t);
    const Vector weight[4] = {hn::Mul(uu, u), hn::Mul(set(3), hn::Mul(uu, t)),
                              hn::Mul(set(3), hn::Mul(u, tt)), hn::Mul(tt, t)};
    const auto coordinate = [&](std::size_t c) {
      Vector sum = hn::Mul(weight[0], set(curves.p[0][c][i]));
      for (std::size_t j = 1; j < 4; ++j) sum = hn::Add(sum, hn::Mul(weight[j], set(curves.p[j][c][i])));
      return sum;
    };
    return {coordinate(0), coordinate(1), coordinate(2)};
  }

  Mask& mask_;
  RunQueue runs_;
  int count_ = 0;  ///< of points before the last one, which has no cone to the next
  Points<float> x_, y_, depth_, radius_;
  Points<std::int32_t> is_cone_;  ///< -1 where a cone leads to the next point, or 0
};

bool has_pixels(const Mask& mask) {
  return std::ranges::any_of(mask.words(), [](std::uint64_t word) { return word != 0; });
}

bool is_hidden(const Mask& mask, const PixelRectangle& box) {
  return mask.get(box.begin_x, box.begin_y) && is_covered(mask, box);
}

/// The stems' segments in order, prepared in batches. A few at the end of the arrays are left to StemPen.
void draw_orthographic(const Plant& plant, const Camera& camera, Mask& mask) {
  const Knots& knots = plant.knots;
  const OrthographicLanes lanes_of_camera(camera);
  const StemPen pen(plant, camera);
  const bool may_be_hidden = has_pixels(mask);  // leaves came first; stems seldom hide each other
  const std::size_t lanes = hn::Lanes(Floats());
  CurveColumns curves;
  PointQueue queue(mask);
  std::size_t first = 0, prepared = 0;  // the columns hold knots [first, prepared)
  std::size_t queued_to = 0;            // the knot at the end of the last segment in the queue
  for (std::size_t stem = 0; stem < plant.stems.size(); ++stem)
    for (std::size_t k = plant.stems.first_knot[stem]; k + 1 < plant.stems.first_knot[stem + 1]; ++k) {
      if (k >= prepared)
        for (first = prepared = k; prepared < first + kBatch && prepared + lanes < knots.size();
             prepared += lanes)
          prepare(knots, first, static_cast<int>(prepared - first), lanes_of_camera, 1 / camera.metres_per_px,
                  mask, curves);
      if (k >= prepared) {
        pen.draw_segment(k, mask);
        continue;
      }
      const int cones = curves.cones[k - first];
      if (cones == 0) continue;
      if (may_be_hidden && is_hidden(mask, curves.box(k - first))) continue;
      queue.add(curves, k - first, cones, queued_to == k && k > plant.stems.first_knot[stem]);
      queued_to = k + 1;
    }
  queue.draw();
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace espalier {

HWY_EXPORT(draw_orthographic);

void draw_stems(const Plant& plant, const Camera& camera, Mask& mask) {
  if (plant.stems.size() == 0) return;
  if (camera.projection == Projection::orthographic) {
    HWY_DYNAMIC_DISPATCH(draw_orthographic)(plant, camera, mask);
    return;
  }
  const StemPen pen(plant, camera);
  for (std::size_t stem = 0; stem < plant.stems.size(); ++stem)
    for (std::size_t k = plant.stems.first_knot[stem]; k + 1 < plant.stems.first_knot[stem + 1]; ++k)
      pen.draw_segment(k, mask);
}

}  // namespace espalier
#endif
