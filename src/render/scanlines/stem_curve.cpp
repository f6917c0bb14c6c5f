// Projection and flattening of single segments, see stem_curve.h.
#include <algorithm>
#include <cmath>

#include <espalier/render/scanlines/scanline_cone.h>
#include <espalier/render/scanlines/stem_curve.h>

namespace espalier {

namespace {

constexpr float kLargestStemPx = 1e6f;  ///< beyond it, float pixels are too coarse to draw

/// A point of a stem in the picture. Differences of depth are lengths along the view, in pixels at that
/// depth.
struct StemPoint {
  float x = 0, y = 0, depth = 0;
};

StemPoint operator+(StemPoint a, StemPoint b) { return {a.x + b.x, a.y + b.y, a.depth + b.depth}; }
StemPoint operator-(StemPoint a, StemPoint b) { return {a.x - b.x, a.y - b.y, a.depth - b.depth}; }
StemPoint operator*(float s, StemPoint a) { return {s * a.x, s * a.y, s * a.depth}; }
float length_px(StemPoint a) { return std::sqrt(a.x * a.x + a.y * a.y); }

struct StemKnot {
  StemPoint point;
  float radius_px = 0;
};

struct StemCurve {
  StemPoint p0, p1, p2, p3;
  float r0, r1;  ///< radius in pixels

  StemPoint at(float t) const {
    const float u = 1 - t;
    return u * u * u * p0 + 3 * u * u * t * p1 + 3 * u * t * t * p2 + t * t * t * p3;
  }
};

/// What is behind a perspective camera has no place in its picture: not a number.
class StemProjection {
 public:
  explicit StemProjection(const Camera& camera)
      : eye_m_(camera.position_m),
        right_(camera.right * (1 / camera.metres_per_px)),
        down_(camera.up * (-1 / camera.metres_per_px)),
        forward_(camera.forward),
        px_per_m_(1 / camera.metres_per_px),
        center_x_(camera.center_x_px),
        center_y_(camera.center_y_px),
        is_perspective_(camera.projection == Projection::perspective) {}

  StemPoint point(Vec3 point_m) const {
    const Vec3 offset = point_m - eye_m_;
    const float depth_m = dot(offset, forward_);
    const float scale = scale_at(depth_m);
    const float depth = is_perspective_ ? std::log(depth_m) : depth_m;
    return {center_x_ + scale * dot(offset, right_), center_y_ + scale * dot(offset, down_),
            depth * px_per_m_};
  }

  StemKnot knot(Vec3 point_m, float radius_m) const {
    const float scale = scale_at(dot(point_m - eye_m_, forward_));
    return {point(point_m), std::max(0.0f, radius_m) * scale * px_per_m_};
  }

  /// Off the axis of a perspective picture, a ball looks larger along the way to the axis: by this factor
  /// across a cone from `a` to `b`.
  float widening(StemPoint a, StemPoint b) const {
    if (!is_perspective_) return 1;
    const float dx = b.x - a.x, dy = b.y - a.y;
    const float across = (a.x - center_x_) * dy - (a.y - center_y_) * dx;
    const float squared = dx * dx + dy * dy;
    return squared > 0 ? std::sqrt(1 + across * across / (squared * px_per_m_ * px_per_m_)) : 1;
  }

 private:
  float scale_at(float depth_m) const {
    if (!is_perspective_) return 1;
    return depth_m > 0 ? 1 / depth_m : NAN;
  }

  Vec3 eye_m_, right_, down_, forward_;
  float px_per_m_, center_x_, center_y_;
  bool is_perspective_;
};

int cones_of(const StemCurve& c) {
  const float bend = std::max(length_px(c.p0 - 2 * c.p1 + c.p2), length_px(c.p1 - 2 * c.p2 + c.p3));
  float count = std::sqrt(6 * bend / (8 * kStemTolerancePx));
  const float thickest = std::max(c.r0, c.r1);
  if (thickest > 1) {  // the chord over the middle handle turns by at most this much
    const float turn = 3 * bend / std::max(length_px(c.p3 - c.p0), 1e-3f);
    count = std::max(count, thickest * std::min(turn, 3.0f) / (2 * kStemTolerancePx));
  }
  return static_cast<int>(std::clamp(std::ceil(count), 1.0f, kMostCones));
}

float tilt_of(StemPoint along) {
  const float across = along.x * along.x + along.y * along.y, depth = along.depth * along.depth;
  return across + depth > 0 ? std::sqrt(depth / (across + depth)) : 0;
}

bool is_usable(const StemCurve& c) {
  const auto is_near = [](StemPoint p) {
    return std::fabs(p.x) < kLargestStemPx && std::fabs(p.y) < kLargestStemPx &&
           std::fabs(p.depth) < 1e3f * kLargestStemPx;
  };
  return is_near(c.p0) && is_near(c.p1) && is_near(c.p2) && is_near(c.p3) && c.r0 < kLargestStemPx &&
         c.r1 < kLargestStemPx && std::max(c.r0, c.r1) > 0;
}

void draw_curve(const StemCurve& curve, const StemProjection& projection, Mask& mask) {
  if (!is_usable(curve)) return;
  const int cones = cones_of(curve);
  StemPoint from = curve.p0;
  float radius = curve.r0;
  for (int i = 1; i <= cones; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(cones);
    const StemPoint to = i < cones ? curve.at(t) : curve.p3;
    const float end_radius = curve.r0 + t * (curve.r1 - curve.r0), wide = projection.widening(from, to);
    draw_cone({from.x, from.y, wide * radius}, {to.x, to.y, wide * end_radius}, tilt_of(to - from), mask);
    from = to;
    radius = end_radius;
  }
}

}  // namespace

void StemPen::draw_segment(std::size_t k, Mask& mask) const {
  const StemProjection projection(camera_);
  const StemKnot from = projection.knot(knots_.point_m[k], knots_.radius_m[k]);
  const StemKnot to = projection.knot(knots_.point_m[k + 1], knots_.radius_m[k + 1]);
  draw_curve({from.point, projection.point(knots_.handle_out_m[k]),
              projection.point(knots_.handle_in_m[k + 1]), to.point, from.radius_px, to.radius_px},
             projection, mask);
}

}  // namespace espalier
