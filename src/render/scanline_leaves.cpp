// A leaf's outline has coordinates x across and y along. A pixel maps to them linearly (orthographic), or as
// a quotient (perspective); inside is then an odd number of crossed edges, as in the Embree reference. Most
// leaves of a crown are a few pixels, most of them set already: only pixels that are not yet set are looked
// at, those of many small leaves together. Vector code is written once with Highway, with products and sums
// rounded apart, so that all instruction sets give the same bits.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/scanline_leaves.cpp"
#include "render/scanline_leaves.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "render/leaf_pixels-inl.h"
#include "render/span_lanes-inl.h"

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

/// Where a batch's numbers begin in the arrays of leaves.
struct LeafRows {
  const Vec3 *position_m, *axis, *side;
  const float *length_m, *width_m;
};

LeafRows rows_from(const Leaves& leaves, std::size_t first) {
  return {&leaves.position_m[first], &leaves.axis[first], &leaves.side[first], &leaves.length_m[first],
          &leaves.width_m[first]};
}

/// A copy of the last leaves, for a batch that would read beyond the arrays. Leaves of size 0 fill it up.
struct LastRows {
  Vec3 position_m[kMostLanes], axis[kMostLanes], side[kMostLanes];
  float length_m[kMostLanes] = {}, width_m[kMostLanes] = {};

  LastRows(const Leaves& leaves, std::size_t first) {
    for (std::size_t i = 0; first + i < leaves.size(); ++i) {
      position_m[i] = leaves.position_m[first + i];
      axis[i] = leaves.axis[first + i];
      side[i] = leaves.side[first + i];
      length_m[i] = leaves.length_m[first + i];
      width_m[i] = leaves.width_m[first + i];
    }
  }
  LeafRows rows() const { return {position_m, axis, side, length_m, width_m}; }
};

/// Inverts (column, row) = base + x·side + y·axis for a vector of leaves, columns [at, …). A leaf seen on
/// edge gets coordinates that are not numbers.
void prepare(const LeafRows& leaves, const Camera& camera, float half_width, const Mask& mask,
             LeafColumns& columns, std::size_t at) {
  const Floats d;
  const Vec3 right = camera.right * (1 / camera.metres_per_px),
             down = camera.up * (-1 / camera.metres_per_px);
  const Vec3 eye = camera.position_m;
  const Vector3 position = load3(leaves.position_m), axis = load3(leaves.axis), side = load3(leaves.side);
  const Vector length_m = hn::LoadU(d, leaves.length_m), width_m = hn::LoadU(d, leaves.width_m);
  const Vector base_x = hn::Add(along(position, right), hn::Set(d, camera.center_x_px - dot(eye, right)));
  const Vector base_y = hn::Add(along(position, down), hn::Set(d, camera.center_y_px - dot(eye, down)));
  const Vector axis_x = hn::Mul(along(axis, right), length_m), axis_y = hn::Mul(along(axis, down), length_m);
  const Vector side_x = hn::Mul(along(side, right), width_m), side_y = hn::Mul(along(side, down), width_m);
  const Vector inverse = hn::Div(hn::Set(d, 1.0f), hn::Sub(hn::Mul(side_x, axis_y), hn::Mul(side_y, axis_x)));
  const Vector x_by_column = hn::Mul(axis_y, inverse), x_by_row = hn::Neg(hn::Mul(axis_x, inverse));
  const Vector y_by_column = hn::Neg(hn::Mul(side_y, inverse)), y_by_row = hn::Mul(side_x, inverse);
  const Vector half = hn::Set(d, half_width);
  const Vector reach_x = hn::Mul(hn::Abs(side_x), half), reach_y = hn::Mul(hn::Abs(side_y), half);
  const Vector zero = hn::Zero(d);
  store_run(hn::Sub(hn::Add(base_x, hn::Min(axis_x, zero)), reach_x),
            hn::Add(hn::Add(base_x, hn::Max(axis_x, zero)), reach_x), mask.width_px(), &columns.begin_x[at],
            &columns.end_x[at]);
  store_run(hn::Sub(hn::Add(base_y, hn::Min(axis_y, zero)), reach_y),
            hn::Add(hn::Add(base_y, hn::Max(axis_y, zero)), reach_y), mask.height_px(), &columns.begin_y[at],
            &columns.end_y[at]);
  const auto from_first = [&](Vector base, const auto& first) {
    const auto pixel = hn::Load(hn::RebindToSigned<Floats>(), &first[at]);
    return hn::Sub(hn::Add(hn::ConvertTo(d, pixel), set(0.5f)), base);
  };
  const Vector column = from_first(base_x, columns.begin_x), row = from_first(base_y, columns.begin_y);
  hn::Store(x_by_column, d, &columns.x_by_column[at]);
  hn::Store(x_by_row, d, &columns.x_by_row[at]);
  hn::Store(y_by_column, d, &columns.y_by_column[at]);
  hn::Store(y_by_row, d, &columns.y_by_row[at]);
  hn::Store(hn::Add(hn::Mul(column, x_by_column), hn::Mul(row, x_by_row)), d, &columns.x[at]);
  hn::Store(hn::Add(hn::Mul(column, y_by_column), hn::Mul(row, y_by_row)), d, &columns.y[at]);
}

/// Leaves [first, first + kMost) or to the end; how many.
std::size_t prepare_some(const Leaves& leaves, std::size_t first, const Camera& camera, float half_width,
                         const Mask& mask, LeafColumns& columns) {
  const std::size_t count = std::min(LeafColumns::kMost, leaves.size() - first), lanes = hn::Lanes(Floats());
  for (std::size_t at = 0; at < count; at += lanes) {
    if (at + lanes <= count)
      prepare(rows_from(leaves, first + at), camera, half_width, mask, columns, at);
    else
      prepare(LastRows(leaves, first + at).rows(), camera, half_width, mask, columns, at);
  }
  return count;
}

void draw_orthographic(const Plant& plant, const Camera& camera, Mask& mask) {
  const Leaves& leaves = plant.leaves;
  const LeafHalf& half = leaf_half(plant.leaf_shape);
  const LeafEdges edges(half);
  LeafColumns columns;
  TileQueue queue(mask);
  std::array<std::int32_t, LeafColumns::kMost> unset;
  for (std::size_t first = 0; first < leaves.size(); first += LeafColumns::kMost) {
    const std::size_t count = prepare_some(leaves, first, camera, half.half_width, mask, columns);
    for (std::size_t at = 0; at < count; at += hn::Lanes(Floats()))
      queue.unset_of_first_pixels(columns, at, &unset[at]);
    for (std::size_t i = 0; i < count; ++i) {
      if (leaves.kind[first + i] != LeafKind::leaf) continue;
      const PixelRectangle box = columns.box(i);
      if (std::max(box.end_x - box.begin_x, box.end_y - box.begin_y) <= TileQueue::kWidestPx)
        queue.add(box, unset[i], i);
      else if (!is_covered(mask, box))
        draw_leaf<false>(columns.map(i), edges, box, mask);
    }
    queue.draw(columns, edges);
  }
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
HWY_EXPORT(draw_perspective);

void draw_leaves(const Plant& plant, const Camera& camera, Mask& mask) {
  if (camera.projection == Projection::orthographic)
    HWY_DYNAMIC_DISPATCH(draw_orthographic)(plant, camera, mask);
  else
    HWY_DYNAMIC_DISPATCH(draw_perspective)(plant, camera, mask);
}

}  // namespace espalier
#endif
