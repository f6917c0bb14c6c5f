// A leaf's outline has coordinates x across and y along. A pixel maps to them linearly (orthographic), or as
// a quotient (perspective); inside is then an odd number of crossed edges, as in the Embree reference. Most
// leaves of a crown fall on pixels that are set: those are left at once. Vector code is written once with
// Highway, with products and sums rounded apart, so that all instruction sets give the same bits.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/scanline_leaves.cpp"
#include "render/scanline_leaves.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "plant/leaf_half.h"
#include "render/span.h"
#include "render/span_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {
namespace {

/// x = (x[0] + x[1]·column + x[2]·row) / w, with column and row at pixel centres; y likewise. In an
/// orthographic picture w = 1. A leaf in front of a perspective camera has w > 0.
struct LeafMap {
  float x[3], y[3], w[3];
};

/// Which of the pixels from `column` on are inside, one bit a lane.
template <bool kPerspective>
std::uint64_t inside_bits(const LeafMap& map, const LeafHalf& half, float column, float row) {
  const Floats d;
  const Vector columns = hn::Add(hn::Set(d, column), hn::Iota(d, 0.0f));
  const auto linear = [&](const float(&a)[3]) {
    return hn::Add(hn::Mul(columns, hn::Set(d, a[1])), hn::Set(d, a[0] + a[2] * row));
  };
  Vector x = linear(map.x), y = linear(map.y);
  auto inside = hn::FirstN(d, 0);
  auto in_front = hn::FirstN(d, hn::Lanes(d));
  if (kPerspective) {
    const Vector w = linear(map.w);
    in_front = hn::Gt(w, hn::Zero(d));
    x = hn::Div(x, w);
    y = hn::Div(y, w);
  }
  x = hn::Abs(x);
  for (const LeafHalf::Edge& edge : half.edges) {
    const Vector from_start = hn::Sub(y, hn::Set(d, edge.y0));
    const Vector edge_x = hn::Add(hn::Set(d, edge.x0), hn::Mul(hn::Set(d, edge.slope), from_start));
    const auto beside = hn::And(hn::Ge(y, hn::Set(d, edge.y0)), hn::Lt(y, hn::Set(d, edge.y1)));
    inside = hn::Xor(inside, hn::And(beside, hn::Lt(x, edge_x)));
  }
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(d, hn::And(inside, in_front), bits);
  return bits[0];
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
      const std::uint64_t inside = inside_bits<kPerspective>(map, half, static_cast<float>(column) + 0.5f,
                                                             static_cast<float>(row) + 0.5f) &
                                   bit_run(0, end - column);
      words[column >> 6] |= inside << (column & 63);
      if ((column & 63) + (end - column) > 64) words[(column >> 6) + 1] |= inside >> (64 - (column & 63));
    }
  }
}

/// Numbers of up to 8 leaves, by lane.
struct OrthographicBatch {
  HWY_ALIGN float x[kMostLanes], x_by_column[kMostLanes], x_by_row[kMostLanes];
  HWY_ALIGN float y[kMostLanes], y_by_column[kMostLanes], y_by_row[kMostLanes];
  HWY_ALIGN std::int32_t begin_x[kMostLanes], end_x[kMostLanes], begin_y[kMostLanes], end_y[kMostLanes];

  LeafMap map(std::size_t i) const {
    return {{x[i], x_by_column[i], x_by_row[i]}, {y[i], y_by_column[i], y_by_row[i]}, {1, 0, 0}};
  }
  PixelRectangle box(std::size_t i) const { return {begin_x[i], end_x[i], begin_y[i], end_y[i]}; }
};

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

/// Inverts (column, row) = base + x·side + y·axis. A leaf seen on edge gets coordinates that are not numbers.
void prepare(const LeafRows& leaves, const Camera& camera, float half_width, const Mask& mask,
             OrthographicBatch& batch) {
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
  hn::Store(x_by_column, d, batch.x_by_column);
  hn::Store(x_by_row, d, batch.x_by_row);
  hn::Store(y_by_column, d, batch.y_by_column);
  hn::Store(y_by_row, d, batch.y_by_row);
  hn::Store(hn::Neg(hn::Add(hn::Mul(base_x, x_by_column), hn::Mul(base_y, x_by_row))), d, batch.x);
  hn::Store(hn::Neg(hn::Add(hn::Mul(base_x, y_by_column), hn::Mul(base_y, y_by_row))), d, batch.y);
  const Vector half = hn::Set(d, half_width);
  const Vector reach_x = hn::Mul(hn::Abs(side_x), half), reach_y = hn::Mul(hn::Abs(side_y), half);
  const Vector zero = hn::Zero(d);
  store_run(hn::Sub(hn::Add(base_x, hn::Min(axis_x, zero)), reach_x),
            hn::Add(hn::Add(base_x, hn::Max(axis_x, zero)), reach_x), mask.width_px(), batch.begin_x,
            batch.end_x);
  store_run(hn::Sub(hn::Add(base_y, hn::Min(axis_y, zero)), reach_y),
            hn::Add(hn::Add(base_y, hn::Max(axis_y, zero)), reach_y), mask.height_px(), batch.begin_y,
            batch.end_y);
}

void draw_orthographic(const Plant& plant, const Camera& camera, Mask& mask) {
  const Leaves& leaves = plant.leaves;
  const LeafHalf& half = leaf_half(plant.leaf_shape);
  const std::size_t lanes = hn::Lanes(Floats());
  OrthographicBatch batch;
  for (std::size_t first = 0; first < leaves.size(); first += lanes) {
    const std::size_t count = std::min(lanes, leaves.size() - first);
    if (count == lanes)
      prepare(rows_from(leaves, first), camera, half.half_width, mask, batch);
    else
      prepare(LastRows(leaves, first).rows(), camera, half.half_width, mask, batch);
    for (std::size_t i = 0; i < count; ++i) {
      if (leaves.kind[first + i] != LeafKind::leaf) continue;
      const PixelRectangle box = batch.box(i);
      if (!box.is_empty() && !is_covered(mask, box)) draw_leaf<false>(batch.map(i), half, box, mask);
    }
  }
}

/// v·(direction of the ray through (column, row)), which is linear in both.
void set_linear(const Camera& camera, Vec3 v, float (&a)[3]) {
  const float by_column = camera.metres_per_px * dot(v, camera.right);
  const float by_row = -camera.metres_per_px * dot(v, camera.up);
  a[1] = by_column;
  a[2] = by_row;
  a[0] = dot(v, camera.forward) - by_column * camera.center_x_px - by_row * camera.center_y_px;
}

/// A ray d meets the leaf's plane at its point x = (stalk·normal · d·x' − stalk·x' · d·normal) / d·normal,
/// where stalk is seen from the eye and x' is the vector dual to the leaf's side; y likewise.
LeafMap perspective_map(const Camera& camera, Vec3 stalk, Vec3 side, Vec3 axis) {
  const Vec3 normal = cross(side, axis);
  const float inverse = 1 / dot(normal, normal), distance = dot(stalk, normal);
  const Vec3 x_dual = cross(axis, normal) * inverse, y_dual = cross(normal, side) * inverse;
  const float sign = distance < 0 ? -1.0f : 1.0f;
  LeafMap map;
  set_linear(camera, (x_dual * distance - normal * dot(stalk, x_dual)) * sign, map.x);
  set_linear(camera, (y_dual * distance - normal * dot(stalk, y_dual)) * sign, map.y);
  set_linear(camera, normal * sign, map.w);
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
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    if (leaves.kind[i] != LeafKind::leaf) continue;
    const Vec3 side = leaves.side[i] * leaves.width_m[i], axis = leaves.axis[i] * leaves.length_m[i];
    const PixelRectangle box =
        perspective_box(camera, leaves.position_m[i], side * half.half_width, axis, mask);
    if (box.is_empty() || is_covered(mask, box)) continue;
    draw_leaf<true>(perspective_map(camera, leaves.position_m[i] - camera.position_m, side, axis), half, box,
                    mask);
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
