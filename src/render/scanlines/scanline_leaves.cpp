// A leaf's outline has coordinates x across and y along. A pixel maps to them linearly (orthographic), or as
// a quotient (perspective); inside is then an odd number of crossed edges, as in the Embree reference. Most
// leaves of a crown are a few pixels, most of them set already: only pixels that are not yet set are looked
// at, those of many small leaves together. Vector code is written once with Highway, with products and sums
// rounded apart, so that all instruction sets give the same bits.
#undef HWY_TARGET_INCLUDE
// NOLINTNEXTLINE(bugprone-macro-parentheses): a name of a file
#define HWY_TARGET_INCLUDE <espalier/render/scanlines/scanline_leaves.cpp>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <espalier/render/scanlines/leaf_tiles-inl.h>
#include <espalier/render/scanlines/scanline_leaves.h>

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {
namespace {

Vector3 load3(const Vec3* from) {
  const Floats d;
  Vector3 v;
  hn::LoadInterleaved3(d, &from->x, v.x, v.y, v.z);
  return v;
}

Vector along(const Vector3& v, Vec3 direction) {
  const Floats d;
  return hn::Add(hn::Add(hn::Mul(v.x, hn::Set(d, direction.x)), hn::Mul(v.y, hn::Set(d, direction.y))),
                 hn::Mul(v.z, hn::Set(d, direction.z)));
}

/// A vector of leaves in the world; some lanes may hold none.
struct PlacedLeaves {
  Vector3 position_m, axis, side;
  Vector length_m, width_m;
  hn::Mask<Integers> is_leaf;
};

hn::Mask<Integers> are_leaves(const LeafKind* kind) {
  static_assert(LeafKind::leaf == LeafKind{0});
  const Integers di;
  const hn::Rebind<std::uint8_t, Integers> d8;
  const auto kinds = hn::PromoteTo(di, hn::LoadU(d8, reinterpret_cast<const std::uint8_t*>(kind)));
  return hn::Eq(kinds, hn::Zero(di));
}

PlacedLeaves leaves_from(const Leaves& leaves, std::size_t first) {
  const Floats d;
  return {load3(&leaves.position_m[first]),     load3(&leaves.axis[first]),
          load3(&leaves.side[first]),           hn::LoadU(d, &leaves.length_m[first]),
          hn::LoadU(d, &leaves.width_m[first]), are_leaves(&leaves.kind[first])};
}

PlacedLeaves leaves_from(const LeafColumns& leaves, std::size_t first) {
  const Floats d;
  const Integers di;
  const auto load = [&](const LeafColumns::Columns3& columns) {
    return Vector3{hn::LoadU(d, columns.x + first), hn::LoadU(d, columns.y + first),
                   hn::LoadU(d, columns.z + first)};
  };
  const auto left = hn::Set(di, static_cast<std::int32_t>(leaves.count - first));
  return {load(leaves.position_m),
          load(leaves.axis),
          load(leaves.side),
          hn::LoadU(d, leaves.length_m + first),
          hn::LoadU(d, leaves.width_m + first),
          hn::Lt(counted_from(0), left)};
}

/// A copy of the last leaves, for a vector that would read beyond the arrays. Leaves of size 0 fill it up.
struct LastRows {
  Vec3 position_m[kMostLanes], axis[kMostLanes], side[kMostLanes];
  float length_m[kMostLanes] = {}, width_m[kMostLanes] = {};
  LeafKind kind[kMostLanes] = {};

  LastRows(const Leaves& leaves, std::size_t first) {
    for (std::size_t i = 0; first + i < leaves.size(); ++i) {
      position_m[i] = leaves.position_m[first + i];
      axis[i] = leaves.axis[first + i];
      side[i] = leaves.side[first + i];
      length_m[i] = leaves.length_m[first + i];
      width_m[i] = leaves.width_m[first + i];
      kind[i] = leaves.kind[first + i];
    }
  }
  PlacedLeaves leaves() const {
    const Floats d;
    return {load3(position_m),      load3(axis),           load3(side),
            hn::LoadU(d, length_m), hn::LoadU(d, width_m), are_leaves(kind)};
  }
};

/// What turns leaves into pixels.
class LeafProjection {
 public:
  LeafProjection(const Camera& camera, float half_width, const Mask& mask)
      : right_(camera.right * (1 / camera.metres_per_px)),
        down_(camera.up * (-1 / camera.metres_per_px)),
        x_(camera.center_x_px - dot(camera.position_m, right_)),
        y_(camera.center_y_px - dot(camera.position_m, down_)),
        half_width_(half_width),
        width_px_(mask.width_px()),
        height_px_(mask.height_px()) {}

  /// Inverts (column, row) = base + x·side + y·axis for a vector of leaves. A leaf seen on edge gets
  /// coordinates that are not numbers, and blossom an empty rectangle.
  HWY_INLINE LeafLanes lanes(const PlacedLeaves& leaves) const {
    const Vector base_x = hn::Add(along(leaves.position_m, right_), set(x_)),
                 base_y = hn::Add(along(leaves.position_m, down_), set(y_));
    const Vector axis_x = hn::Mul(along(leaves.axis, right_), leaves.length_m),
                 axis_y = hn::Mul(along(leaves.axis, down_), leaves.length_m);
    const Vector side_x = hn::Mul(along(leaves.side, right_), leaves.width_m),
                 side_y = hn::Mul(along(leaves.side, down_), leaves.width_m);
    const Vector inverse = hn::Div(set(1), hn::Sub(hn::Mul(side_x, axis_y), hn::Mul(side_y, axis_x)));
    LeafLanes lanes;
    lanes.columns = run(base_x, axis_x, side_x, width_px_);
    lanes.rows = only_leaves(run(base_y, axis_y, side_y, height_px_), leaves.is_leaf);
    const Vector column = from_first(lanes.columns, base_x), row = from_first(lanes.rows, base_y);
    lanes.x = linear(hn::Mul(axis_y, inverse), hn::Neg(hn::Mul(axis_x, inverse)), column, row);
    lanes.y = linear(hn::Neg(hn::Mul(side_y, inverse)), hn::Mul(side_x, inverse), column, row);
    return lanes;
  }

 private:
  /// The pixels that a leaf's rectangle spans.
  RunLanes run(Vector base, Vector axis, Vector side, int size) const {
    const Vector reach = hn::Mul(hn::Abs(side), set(half_width_)), zero = hn::Zero(Floats());
    return run_lanes(hn::Sub(hn::Add(base, hn::Min(axis, zero)), reach),
                     hn::Add(hn::Add(base, hn::Max(axis, zero)), reach), size);
  }

  static RunLanes only_leaves(const RunLanes& rows, hn::Mask<Integers> is_leaf) {
    return {rows.begin, hn::IfThenElse(is_leaf, rows.end, rows.begin)};
  }

  /// The way from the leaf's base to the centre of its first pixel.
  static Vector from_first(const RunLanes& run, Vector base) {
    return hn::Sub(hn::Add(hn::ConvertTo(Floats(), run.begin), set(0.5f)), base);
  }

  static LinearLanes linear(Vector by_column, Vector by_row, Vector column, Vector row) {
    return {hn::Add(hn::Mul(column, by_column), hn::Mul(row, by_row)), by_column, by_row};
  }

  Vec3 right_, down_;
  float x_, y_, half_width_;
  int width_px_, height_px_;
};

/// One by one, those leaves that are too large to be tiles.
void draw_large(const LeafLanes& leaves, const LeafEdges& edges, Mask& mask) {
  const Integers di;
  alignas(64) std::array<std::array<float, kMostLanes>, 6> maps;
  alignas(64) std::array<std::array<std::int32_t, kMostLanes>, 4> boxes;
  std::size_t i = 0;
  for (const LinearLanes& map : {leaves.x, leaves.y})
    for (const Vector number : {map.at_first, map.by_column, map.by_row})
      hn::Store(number, Floats(), maps[i++].data());
  i = 0;
  for (const RunLanes& run : {leaves.columns, leaves.rows})
    for (const IntegerLanes pixel : {run.begin, run.end}) hn::Store(pixel, di, boxes[i++].data());
  for (std::size_t lane = 0; lane < hn::Lanes(di); ++lane) {
    const PixelRectangle box{boxes[0][lane], boxes[1][lane], boxes[2][lane], boxes[3][lane]};
    if (std::max(box.end_x - box.begin_x, box.end_y - box.begin_y) <= LeafTiles::kWidestPx) continue;
    if (box.is_empty() || is_covered(mask, box)) continue;
    draw_leaf<false>({{maps[0][lane], maps[1][lane], maps[2][lane]},
                      {maps[3][lane], maps[4][lane], maps[5][lane]},
                      {1, 0, 0}},
                     edges, box, mask);
  }
}

/// Draws vectors of leaves as they come.
class LeafDrawing {
 public:
  LeafDrawing(int shape, const Camera& camera, Mask& mask)
      : edges_(leaf_half(shape)),
        projection_(camera, leaf_half(shape).half_width, mask),
        tiles_(edges_, mask),
        mask_(mask) {}

  HWY_INLINE void add(const PlacedLeaves& leaves) {
    const Integers di;
    const LeafLanes some = projection_.lanes(leaves);
    tiles_.add(some);
    const auto width = hn::Sub(some.columns.end, some.columns.begin),
               height = hn::Sub(some.rows.end, some.rows.begin);
    if (!hn::AllFalse(di, hn::Gt(hn::Max(width, height), hn::Set(di, LeafTiles::kWidestPx))))
      draw_large(some, edges_, mask_);
  }

  void finish() { tiles_.draw(); }

 private:
  LeafEdges edges_;
  LeafProjection projection_;
  LeafTiles tiles_;
  Mask& mask_;
};

void draw_orthographic(const Plant& plant, const Camera& camera, Mask& mask) {
  const Leaves& leaves = plant.leaves;
  LeafDrawing drawing(plant.leaf_shape, camera, mask);
  const std::size_t lanes = hn::Lanes(Floats());
  for (std::size_t first = 0; first < leaves.size(); first += lanes)
    drawing.add(first + lanes <= leaves.size() ? leaves_from(leaves, first)
                                               : LastRows(leaves, first).leaves());
  drawing.finish();
}

void draw_columns(const LeafColumns& leaves, const Camera& camera, Mask& mask) {
  LeafDrawing drawing(leaves.shape, camera, mask);
  for (std::size_t first = 0; first < leaves.count; first += hn::Lanes(Floats()))
    drawing.add(leaves_from(leaves, first));
  drawing.finish();
}

/// v·(direction of the ray through a pixel), which is linear in its column and row, counted from `first`.
void set_linear(const Camera& camera, const PixelRectangle& first, Vec3 v, float (&a)[3]) {
  const float by_column = camera.metres_per_px * dot(v, camera.right);
  const float by_row = -camera.metres_per_px * dot(v, camera.up);
  a[1] = by_column;
  a[2] = by_row;
  a[0] = dot(v, camera.forward) +
         by_column * (static_cast<float>(first.begin_x) + 0.5f - camera.center_x_px) +
         by_row * (static_cast<float>(first.begin_y) + 0.5f - camera.center_y_px);
}

/// A ray d meets the leaf's plane at its point x = (stalk·normal · d·x' − stalk·x' · d·normal) / d·normal,
/// where stalk is seen from the eye and x' is the vector dual to the leaf's side; y likewise.
LeafMap perspective_map(const Camera& camera, const PixelRectangle& box, Vec3 stalk, Vec3 side, Vec3 axis) {
  const Vec3 normal = cross(side, axis);
  const float inverse = 1 / dot(normal, normal), distance = dot(stalk, normal);
  const Vec3 x_dual = cross(axis, normal) * inverse, y_dual = cross(normal, side) * inverse;
  const float sign = distance < 0 ? -1.0f : 1.0f;
  LeafMap map;
  set_linear(camera, box, (x_dual * distance - normal * dot(stalk, x_dual)) * sign, map.x);
  set_linear(camera, box, (y_dual * distance - normal * dot(stalk, y_dual)) * sign, map.y);
  set_linear(camera, box, normal * sign, map.w);
  return map;
}

/// The pixels of the rectangle around a leaf; all pixels where it reaches behind the eye.
PixelRectangle perspective_box(const Camera& camera, Vec3 stalk_m, Vec3 half_side, Vec3 axis,
                               const Mask& mask) {
  float left = INFINITY, right = -INFINITY, top = INFINITY, bottom = -INFINITY, nearest_m = INFINITY;
  for (const Vec3 corner :
       {stalk_m - half_side, stalk_m + half_side, stalk_m + axis - half_side, stalk_m + axis + half_side}) {
    const PicturePoint p = project(camera, corner);
    left = std::min(left, p.x_px), right = std::max(right, p.x_px);
    top = std::min(top, p.y_px), bottom = std::max(bottom, p.y_px);
    nearest_m = std::min(nearest_m, p.depth_m);
  }
  if (!(nearest_m > 0)) return {0, mask.width_px(), 0, mask.height_px()};
  const PixelRun columns = centres_between(left, right, mask.width_px());
  const PixelRun rows = centres_between(top, bottom, mask.height_px());
  return {columns.begin, columns.end, rows.begin, rows.end};
}

void draw_perspective(const Plant& plant, const Camera& camera, Mask& mask) {
  const Leaves& leaves = plant.leaves;
  const LeafHalf& half = leaf_half(plant.leaf_shape);
  const LeafEdges edges(half);
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    if (leaves.kind[i] != LeafKind::leaf) continue;
    const Vec3 side = leaves.side[i] * leaves.width_m[i], axis = leaves.axis[i] * leaves.length_m[i];
    const PixelRectangle box =
        perspective_box(camera, leaves.position_m[i], side * half.half_width, axis, mask);
    if (box.is_empty() || is_covered(mask, box)) continue;
    draw_leaf<true>(perspective_map(camera, box, leaves.position_m[i] - camera.position_m, side, axis), edges,
                    box, mask);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace espalier {

HWY_EXPORT(draw_orthographic);
HWY_EXPORT(draw_columns);
HWY_EXPORT(draw_perspective);

void draw_leaves(const Plant& plant, const Camera& camera, Mask& mask) {
  if (camera.projection == Projection::orthographic)
    HWY_DYNAMIC_DISPATCH(draw_orthographic)(plant, camera, mask);
  else
    HWY_DYNAMIC_DISPATCH(draw_perspective)(plant, camera, mask);
}

void draw_leaves(const LeafColumns& leaves, const Camera& camera, Mask& mask) {
  HWY_DYNAMIC_DISPATCH(draw_columns)(leaves, camera, mask);
}

}  // namespace espalier
#endif
