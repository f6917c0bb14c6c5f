// Curves in the picture, cut into cones. A cubic curve cut into n equal parts deviates from its chords by at
// most max|B''|/(8n²), and at a joint that turns by an angle a the cones gap by radius·a/2. Most segments of
// a tree are one cone: those of an orthographic picture are prepared a vector of segments at a time, and
// their scan lines a vector of rows at a time. All else takes the plain path, with the same formulas.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/scanline_stems.cpp"
#include "render/scanline_stems.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "render/scanline_cone.h"
#include "render/span.h"
#include "render/span_lanes-inl.h"
#include "render/stem_curve.h"

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {
namespace {

constexpr int kBatch = 64;  ///< knots prepared at once
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

/// One number for each segment or cone of a batch.
using Column = std::array<float, kBatch + kMostLanes>;

/// What cones need for their scan lines.
struct ConeColumns {
  alignas(64) std::array<Column, 6> at_zero, by_row;  ///< three lower and three upper bounds of x
  alignas(64) Column x0, y0, x1, y1, r0, r1, tilt;    ///< both ends; rows count from y0
  alignas(64) Column top, bottom;
};

/// Curves of segments, each control point a row of three columns: x, y, depth.
struct CurveColumns {
  alignas(64) std::array<std::array<Column, 3>, 4> p;
  alignas(64) Column cones;
  std::array<std::int32_t, kBatch + kMostLanes> begin_x, end_x, begin_y, end_y;  ///< pixels they can meet

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

Vector length2(Vector x, Vector y) { return hn::Sqrt(hn::Add(hn::Mul(x, x), hn::Mul(y, y))); }

/// |a - 2b + c|.
Vector bend(const PictureLanes& a, const PictureLanes& b, const PictureLanes& c) {
  return length2(hn::Add(hn::Sub(a.x, hn::Add(b.x, b.x)), c.x),
                 hn::Add(hn::Sub(a.y, hn::Add(b.y, b.y)), c.y));
}

/// StemCurve::cones, not rounded up.
Vector cones_of(const PictureLanes& p0, const PictureLanes& p1, const PictureLanes& p2,
                const PictureLanes& p3, Vector thickest, Vector chord) {
  const Vector most = hn::Max(bend(p0, p1, p2), bend(p1, p2, p3));
  const Vector for_chord = hn::Sqrt(hn::Mul(most, set(6 / (8 * kStemTolerancePx))));
  const Vector turn = hn::Min(hn::Div(hn::Mul(set(3), most), hn::Max(chord, set(1e-3f))), set(3));
  const Vector for_gaps = hn::Mul(hn::Mul(thickest, turn), set(1 / (2 * kStemTolerancePx)));
  return hn::IfThenElse(hn::Gt(thickest, set(1)), hn::Max(for_chord, for_gaps), for_chord);
}

void store(Vector v, Column& column, int at) {
  hn::StoreU(v, Floats(), &column[static_cast<std::size_t>(at)]);
}

/// The half planes of draw_cone [scanline_cone.cpp], each as the bound it sets on x.
void set_bounds(Vector x, Vector radius, Vector end_radius, Vector ux, Vector uy, Vector axis,
                ConeColumns& columns, int at) {
  const Floats d;
  const Vector slope = hn::Div(hn::Sub(end_radius, radius), axis);
  const auto store_bound = [&](std::size_t bound, const Line& line) {
    store(line.at_zero, columns.at_zero[bound], at);
    store(line.by_row, columns.by_row[bound], at);
  };
  // c·x <= e + f·y, an upper bound where c > 0
  const auto limit = [&](Vector c, Vector e, Vector f) {
    const Vector inverse = hn::Div(set(1), hn::CopySign(hn::Max(hn::Abs(c), set(1e-12f)), c));
    return Limit{{hn::Add(x, hn::Mul(e, inverse)), hn::Mul(f, inverse)}, hn::Gt(inverse, hn::Zero(d))};
  };
  const Line none_low{set(-kFarPx), hn::Zero(d)}, none_high{set(kFarPx), hn::Zero(d)};
  const Limit foot = limit(hn::Neg(ux), hn::Zero(d), uy), tip = limit(ux, axis, hn::Neg(uy));
  store_bound(0, choose(foot.is_upper, tip.line, foot.line));
  store_bound(3, choose(foot.is_upper, foot.line, tip.line));
  const Vector leaning = hn::Mul(slope, ux), rising = hn::Mul(slope, uy);
  const Limit left = limit(hn::Sub(hn::Neg(uy), leaning), radius, hn::Sub(rising, ux));
  const Limit right = limit(hn::Sub(uy, leaning), radius, hn::Add(rising, ux));
  store_bound(1, choose(left.is_upper, none_low, left.line));
  store_bound(4, choose(left.is_upper, left.line, none_high));
  store_bound(2, choose(right.is_upper, none_low, right.line));
  store_bound(5, choose(right.is_upper, right.line, none_high));
}

/// Cones from (p0, r0) to (p1, r1).
void set_cones(const PictureLanes& p0, const PictureLanes& p1, Vector r0, Vector r1, ConeColumns& columns,
               int at) {
  const Vector dx = hn::Sub(p1.x, p0.x), dy = hn::Sub(p1.y, p0.y), depth = hn::Sub(p1.depth, p0.depth);
  const Vector axis = hn::Max(length2(dx, dy), set(1e-6f)), inverse = hn::Div(set(1), axis);
  const Vector ux = hn::Mul(dx, inverse), uy = hn::Mul(dy, inverse);
  set_bounds(p0.x, r0, r1, ux, uy, axis, columns, at);
  const Vector reach0 = hn::Mul(r0, hn::Abs(ux)), reach1 = hn::Mul(r1, hn::Abs(ux));
  store(p0.x, columns.x0, at);
  store(p0.y, columns.y0, at);
  store(p1.x, columns.x1, at);
  store(p1.y, columns.y1, at);
  store(r0, columns.r0, at);
  store(r1, columns.r1, at);
  store(hn::Div(hn::Abs(depth), hn::Max(length2(axis, depth), set(1e-6f))), columns.tilt, at);
  store(hn::Min(hn::Sub(p0.y, reach0), hn::Sub(p1.y, reach1)), columns.top, at);
  store(hn::Max(hn::Add(p0.y, reach0), hn::Add(p1.y, reach1)), columns.bottom, at);
}

/// Segments from knots [first + at, …) of the plant to their next knots: their curves, and as one cone each.
void prepare(const Knots& knots, std::size_t first, int at, const OrthographicLanes& camera, float px_per_m,
             const Mask& mask, CurveColumns& curves, ConeColumns& cones) {
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
  const Vector r0 = radius_from(k), r1 = radius_from(k + 1);
  set_cones(p[0], p[3], r0, r1, cones, at);
  const auto reach = hn::Max(r0, r1);
  const auto least = [](Vector a, Vector b, Vector c, Vector d) {
    return hn::Min(hn::Min(a, b), hn::Min(c, d));
  };
  const auto most = [](Vector a, Vector b, Vector c, Vector d) {
    return hn::Max(hn::Max(a, b), hn::Max(c, d));
  };
  const auto i = static_cast<std::size_t>(at);
  store_run(hn::Sub(least(p[0].x, p[1].x, p[2].x, p[3].x), reach),
            hn::Add(most(p[0].x, p[1].x, p[2].x, p[3].x), reach), mask.width_px(), &curves.begin_x[i],
            &curves.end_x[i]);
  store_run(hn::Sub(least(p[0].y, p[1].y, p[2].y, p[3].y), reach),
            hn::Add(most(p[0].y, p[1].y, p[2].y, p[3].y), reach), mask.height_px(), &curves.begin_y[i],
            &curves.end_y[i]);
  const Vector chord = length2(hn::Sub(p[3].x, p[0].x), hn::Sub(p[3].y, p[0].y));
  store(cones_of(p[0], p[1], p[2], p[3], hn::Max(r0, r1), chord), curves.cones, at);
}

/// The points of curve i at t.
PictureLanes on_curve(const CurveColumns& curves, std::size_t i, Vector t) {
  const Vector u = hn::Sub(set(1), t), uu = hn::Mul(u, u), tt = hn::Mul(t, t);
  const Vector weight[4] = {hn::Mul(uu, u), hn::Mul(set(3), hn::Mul(uu, t)), hn::Mul(set(3), hn::Mul(u, tt)),
                            hn::Mul(tt, t)};
  const auto coordinate = [&](std::size_t c) {
    Vector sum = hn::Mul(weight[0], set(curves.p[0][c][i]));
    for (std::size_t j = 1; j < 4; ++j) sum = hn::Add(sum, hn::Mul(weight[j], set(curves.p[j][c][i])));
    return sum;
  };
  return {coordinate(0), coordinate(1), coordinate(2)};
}

void draw_rows(const ConeColumns& columns, std::size_t i, const PixelRun& rows, Mask& mask) {
  const Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto bound = [&](std::size_t b, Vector y) {
    return hn::Add(set(columns.at_zero[b][i]), hn::Mul(set(columns.by_row[b][i]), y));
  };
  alignas(32) std::array<std::int32_t, kMostLanes> begins, ends;
  std::uint64_t* words = mask.row(rows.begin).data();
  for (int row = rows.begin; row < rows.end; row += lanes) {
    const Vector y = hn::Add(set(static_cast<float>(row) + 0.5f - columns.y0[i]), hn::Iota(d, 0.0f));
    store_run(hn::Max(hn::Max(bound(0, y), bound(1, y)), bound(2, y)),
              hn::Min(hn::Min(bound(3, y), bound(4, y)), bound(5, y)), mask.width_px(), begins.data(),
              ends.data());
    const auto count = static_cast<std::size_t>(std::min(lanes, rows.end - row));
    for (std::size_t j = 0; j < count; ++j, words += mask.words_per_row())
      set_short_span(words, begins[j], ends[j]);
  }
}

void draw_cone_at(const ConeColumns& cones, std::size_t i, Mask& mask) {
  const PixelRun rows = centres_between(cones.top[i], cones.bottom[i], mask.height_px());
  if (rows.begin < rows.end) draw_rows(cones, i, rows, mask);
  if (std::max(cones.r0[i], cones.r1[i]) * cones.tilt[i] > kThinnestEllipsePx)
    draw_cone_ends({cones.x0[i], cones.y0[i], cones.r0[i]}, {cones.x1[i], cones.y1[i], cones.r1[i]},
                   cones.tilt[i], mask);
}

/// A bent segment, as `count` cones, a vector of cones at a time.
void draw_bent(const CurveColumns& curves, const ConeColumns& chords, std::size_t i, int count,
               ConeColumns& scratch, Mask& mask) {
  const int lanes = static_cast<int>(hn::Lanes(Floats()));
  const Vector step = set(1 / static_cast<float>(count)), r0 = set(chords.r0[i]), r1 = set(chords.r1[i]);
  for (int first = 0; first < count; first += lanes) {
    const Vector index = hn::Iota(Floats(), static_cast<float>(first));
    const Vector from = hn::Mul(index, step), to = hn::Mul(hn::Add(index, set(1)), step);
    const auto radius = [&](Vector t) { return hn::Add(r0, hn::Mul(t, hn::Sub(r1, r0))); };
    set_cones(on_curve(curves, i, from), on_curve(curves, i, to), radius(from), radius(to), scratch, 0);
    for (int j = 0; j < std::min(lanes, count - first); ++j)
      draw_cone_at(scratch, static_cast<std::size_t>(j), mask);
  }
}

/// The stems' segments in order, prepared in batches. A few at the end of the arrays are left to StemPen.
void draw_orthographic(const Plant& plant, const Camera& camera, Mask& mask) {
  const Knots& knots = plant.knots;
  const OrthographicLanes lanes_of_camera(camera);
  const StemPen pen(plant, camera);
  const std::size_t lanes = hn::Lanes(Floats());
  CurveColumns curves;
  ConeColumns chords, pieces;
  std::size_t first = 0, prepared = 0;  // the columns hold knots [first, prepared)
  for (std::size_t stem = 0; stem < plant.stems.size(); ++stem)
    for (std::size_t k = plant.stems.first_knot[stem]; k + 1 < plant.stems.first_knot[stem + 1]; ++k) {
      if (k >= prepared)
        for (first = prepared = k; prepared < first + kBatch && prepared + lanes < knots.size();
             prepared += lanes)
          prepare(knots, first, static_cast<int>(prepared - first), lanes_of_camera, 1 / camera.metres_per_px,
                  mask, curves, chords);
      if (k >= prepared) {
        pen.draw_segment(k, mask);
        continue;
      }
      const PixelRectangle box = curves.box(k - first);
      if (box.is_empty() || is_covered(mask, box)) continue;
      const float cones = curves.cones[k - first];
      if (cones <= 1)
        draw_cone_at(chords, k - first, mask);
      else if (cones < kFarPx)
        draw_bent(curves, chords, k - first, cone_count(cones), pieces, mask);
    }
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
