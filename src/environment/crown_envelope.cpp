// Everything about the envelope follows from one number for each of top and bottom: the level of a point, 1
// on the surface, less inside. It needs where the ray from the apex through the point, seen from above, meets
// the rim: a quarter of an ellipse, in closed form. In double: heights near the rim change with the root of 1
// − ρ.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <espalier/core/error.h>
#include <espalier/environment/crown_envelope.h>

namespace espalier {

namespace {

constexpr float kLeastShape = 0.1f, kMostShape = 100;
constexpr std::array<const char*, 4> kSides{"right", "back", "left", "front"};

bool is_finite(Vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void check_point(const char* what, Vec3 p) {
  if (!is_finite(p))
    throw_input_error("crown: {} is at {}, {}, {}, expected finite numbers", what, p.x, p.y, p.z);
}

void check_bulge(const char* where, float shape) {
  if (!(shape >= kLeastShape && shape <= kMostShape))
    throw_input_error("crown: shape {} is {}, expected {} .. {}", where, shape, kLeastShape, kMostShape);
}

void check_shape(const CrownShape& shape) {
  check_point("top", shape.top_m);
  check_point("bottom", shape.bottom_m);
  if (!(shape.top_m.z > shape.bottom_m.z))
    throw_input_error("crown: top is {}, expected more than its bottom, {}", shape.top_m.z, shape.bottom_m.z);
  for (std::size_t side = 0; side < 4; ++side) {
    if (!(shape.radius_m[side] > 0 && std::isfinite(shape.radius_m[side])))
      throw_input_error("crown: radius to the {} is {}, expected a positive number", kSides[side],
                        shape.radius_m[side]);
    if (!(shape.rim_m[side] >= shape.bottom_m.z && shape.rim_m[side] <= shape.top_m.z))
      throw_input_error("crown: rim at the {} is {}, expected from bottom to top, {} .. {}", kSides[side],
                        shape.rim_m[side], shape.bottom_m.z, shape.top_m.z);
  }
  check_bulge("above", shape.shape_above);
  check_bulge("below", shape.shape_below);
}

double squared(double x) { return x * x; }

}  // namespace

CrownEnvelope::CrownEnvelope(const CrownShape& shape)
    : shape_(shape),
      top_(apex(shape.top_m, shape.shape_above)),
      bottom_(apex(shape.bottom_m, shape.shape_below)) {
  check_shape(shape);
  set_quarters();
  check_is_within_rim("top", shape.top_m);
  check_is_within_rim("bottom", shape.bottom_m);
  top_.clearance_m = clearance_m(top_);
  bottom_.clearance_m = clearance_m(bottom_);
}

CrownEnvelope::Apex CrownEnvelope::apex(Vec3 point_m, float exponent) {
  return {point_m.x, point_m.y, point_m.z, exponent};
}

/// Quarter i is on the left where i has its first bit, in front where it has its second.
void CrownEnvelope::set_quarters() {
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t along_x = i & 1 ? 2 : 0, along_y = i & 2 ? 3 : 1;
    quarters_[i] = {i & 1 ? -1. : 1.,
                    i & 2 ? -1. : 1.,
                    1 / squared(shape_.radius_m[along_x]),
                    1 / squared(shape_.radius_m[along_y]),
                    shape_.rim_m[along_x],
                    shape_.rim_m[along_y]};
  }
}

void CrownEnvelope::check_is_within_rim(const char* what, Vec3 point_m) const {
  const Quarter& q = quarters_[(point_m.x < 0 ? 1U : 0U) | (point_m.y < 0 ? 2U : 0U)];
  const double share = std::sqrt(squared(point_m.x) * q.inverse_rx2 + squared(point_m.y) * q.inverse_ry2);
  if (!(share < 0.999))
    throw_input_error(
        "crown: {} is {:.3g} times as far out as the rim, seen from above, expected less than 1", what,
        share);
}

/// The distance to a polygon within the rim.
double CrownEnvelope::clearance_m(const Apex& apex) const {
  constexpr int kEdges = 64;
  const auto corner = [&](int i) {
    const double angle = 2 * std::numbers::pi * (i % kEdges) / kEdges;
    const double c = std::cos(angle), s = std::sin(angle);
    return std::array{c * shape_.radius_m[c >= 0 ? 0 : 2] - apex.x,
                      s * shape_.radius_m[s >= 0 ? 1 : 3] - apex.y};
  };
  double least_m = INFINITY;
  auto from = corner(0);
  for (int i = 1; i <= kEdges; ++i) {
    const auto to = corner(i);
    const double across = from[0] * to[1] - from[1] * to[0];
    least_m = std::min(least_m, across / std::hypot(to[0] - from[0], to[1] - from[1]));
    from = to;
  }
  return std::max(least_m, 0.);
}

/// Where the ray from (x, y) along (dx, dy) leaves the rim; 0 steps where it does not meet it. The rim is
/// convex, so there is one such place, and it is where the ellipse of that quarter is left as well.
CrownEnvelope::RimHit CrownEnvelope::rim_hit(double x, double y, double dx, double dy) const {
  const unsigned ahead = (dx < 0 ? 1U : 0U) | (dy < 0 ? 2U : 0U);
  for (unsigned turn = 0; turn < 4; ++turn) {
    const Quarter& q = quarters_[ahead ^ turn];
    const double a = dx * dx * q.inverse_rx2 + dy * dy * q.inverse_ry2;
    const double b = x * dx * q.inverse_rx2 + y * dy * q.inverse_ry2;
    const double c = x * x * q.inverse_rx2 + y * y * q.inverse_ry2 - 1;
    const double discriminant = b * b - a * c;
    if (discriminant < 0) continue;
    const double steps = (std::sqrt(discriminant) - b) / a;
    const double hit_x = x + steps * dx, hit_y = y + steps * dy;
    const double share_x = hit_x * hit_x * q.inverse_rx2, share_y = hit_y * hit_y * q.inverse_ry2;
    constexpr double kRounding = 1e-18;  // of a square
    if (steps < 0 || (hit_x * q.sign_x < 0 && share_x > kRounding) ||
        (hit_y * q.sign_y < 0 && share_y > kRounding))
      continue;
    return {steps, q.height_x * share_x + q.height_y * share_y};
  }
  return {0, 0};
}

/// The rim in the direction from the apex to (x, y).
CrownEnvelope::RimHit CrownEnvelope::rim_beyond(const Apex& apex, double x, double y) const {
  const double dx = x - apex.x, dy = y - apex.y;
  if (dx * dx + dy * dy > 1e-24 * squared(apex.clearance_m)) return rim_hit(apex.x, apex.y, dx, dy);
  return {INFINITY, rim_hit(apex.x, apex.y, 1, 0).height_m};
}

/// How far the surface at ρ has fallen from the apex (0) to the rim (1).
double CrownEnvelope::fall(double rho, double exponent) const {
  if (shape_.profile == CrownProfile::power) return std::pow(rho, exponent);
  return 1 - std::pow(1 - std::pow(rho, exponent), 1 / exponent);
}

/// On the other side of the rim's height only ρ counts.
double CrownEnvelope::level(const Apex& apex, double x, double y, double z) const {
  const RimHit rim = rim_beyond(apex, x, y);
  const double rho = 1 / rim.steps;
  const double flat_m = 1e-6 * (top_.z - bottom_.z), full_m = std::fabs(apex.z - rim.height_m);
  const double above_m = &apex == &top_ ? z - rim.height_m : rim.height_m - z;
  const double rise = above_m / std::max(full_m, flat_m);  // 0 at the rim, 1 at the apex
  if (shape_.profile == CrownProfile::power) return std::pow(rho, apex.exponent) + std::max(rise, 0.);
  if (rise <= 0) return rho;
  if (apex.exponent == 2) return std::sqrt(rho * rho + rise * rise);
  const double more = std::max(rho, rise), less = std::min(rho, rise);
  return more * std::pow(1 + std::pow(less / more, apex.exponent), 1 / apex.exponent);
}

/// Less than 0 inside, 0 on the surface.
double CrownEnvelope::outside(double x, double y, double z) const {
  return std::max(level(top_, x, y, z), level(bottom_, x, y, z)) - 1;
}

double CrownEnvelope::height_m(const Apex& apex, const RimHit& rim) const {
  return std::lerp(apex.z, rim.height_m, fall(1 / rim.steps, apex.exponent));
}

std::optional<CrownEnvelope::Heights> CrownEnvelope::heights_m(double x_m, double y_m) const {
  const RimHit of_bottom = rim_beyond(bottom_, x_m, y_m), of_top = rim_beyond(top_, x_m, y_m);
  if (!(of_bottom.steps >= 1 && of_top.steps >= 1)) return std::nullopt;
  return Heights{height_m(bottom_, of_bottom), height_m(top_, of_top)};
}

/// To first order: f/|∇f| of f = level − 1, not deeper than the crown is thick.
float CrownEnvelope::signed_distance_m(Vec3 point_m) const {
  const double x = point_m.x, y = point_m.y, z = point_m.z, f = outside(x, y, z);
  const double deepest_m = std::min({top_.clearance_m, bottom_.clearance_m, 0.5 * (top_.z - bottom_.z)});
  const double step_m = 1e-4 * deepest_m;
  const double slope = std::hypot(outside(x + step_m, y, z) - outside(x - step_m, y, z),
                                  outside(x, y + step_m, z) - outside(x, y - step_m, z),
                                  outside(x, y, z + step_m) - outside(x, y, z - step_m)) /
                       (2 * step_m);
  return static_cast<float>(std::max(slope > 0 ? f / slope : -deepest_m, -deepest_m));
}

// ρ is a gauge: over a disc in plan it grows by no more than the disc's radius over the apex's clearance. And
// the surface at a given ρ rises with the rim, so that the lowest rim gives a height below it everywhere.
bool CrownEnvelope::surely_contains_ball(Vec3 center_m, float radius_m) const {
  const auto most_rho = [&](const Apex& apex) {
    return 1 / rim_beyond(apex, center_m.x, center_m.y).steps + radius_m / apex.clearance_m;
  };
  const double above = most_rho(top_), below = most_rho(bottom_);
  if (!(above < 1 && below < 1)) return false;
  const auto [lowest_m, highest_m] = std::minmax_element(shape_.rim_m.begin(), shape_.rim_m.end());
  return center_m.z + radius_m < std::lerp(top_.z, double{*lowest_m}, fall(above, top_.exponent)) &&
         center_m.z - radius_m > std::lerp(bottom_.z, double{*highest_m}, fall(below, bottom_.exponent));
}

/// A function's values at the ends of a span, of which one is above 0 and the other not.
struct CrownEnvelope::Bracket {
  double a, value_a, b, value_b;
};

/// From a point inside to one outside, between 0 and `end`; no further apart than an eighth where the crown
/// is hollow or the ray starts outside. Nothing where no point is inside.
template <typename Function>
std::optional<CrownEnvelope::Bracket> CrownEnvelope::first_exit(const Function& value_at, double end) const {
  const double first = value_at(0);
  if (first <= 0 && top_.exponent >= 1 && bottom_.exponent >= 1) return Bracket{0, first, end, value_at(end)};
  constexpr int kSamples = 8;
  Bracket bracket{0, first, 0, first};
  for (int i = 1; i <= kSamples; ++i) {
    bracket = {bracket.b, bracket.value_b, end * i / kSamples, value_at(end * i / kSamples)};
    if (bracket.value_a <= 0 && bracket.value_b > 0) break;
  }
  return bracket.value_a <= 0 || bracket.value_b <= 0 ? std::optional(bracket) : std::nullopt;
}

/// Secants by the method of Anderson and Björck 1973, which pulls in the end that stays; for the few rays
/// that are not there after eight, halving.
template <typename Function>
double CrownEnvelope::root(const Function& value_at, Bracket bracket) {
  constexpr int kSecants = 8, kHalvings = 20;
  constexpr double kClose = 5e-5;
  double weight = bracket.value_a;
  for (int step = 0; step < kSecants + kHalvings && std::fabs(bracket.value_b) > kClose; ++step) {
    const double share = step < kSecants ? bracket.value_b / (bracket.value_b - weight) : 0.5;
    const double t = std::lerp(bracket.b, bracket.a, share), value = value_at(t);
    if ((value > 0) != (bracket.value_b > 0)) {
      bracket.a = bracket.b;
      weight = bracket.value_b;
    } else
      weight *= value / bracket.value_b < 1 ? 1 - value / bracket.value_b : 0.5;
    bracket.b = t, bracket.value_b = value;
  }
  return bracket.b;
}

float CrownEnvelope::reach_m(Vec3 from_m, Vec3 direction) const {
  const bool is_upright = direction.x == 0 && direction.y == 0;
  double end = is_upright ? INFINITY : rim_hit(from_m.x, from_m.y, direction.x, direction.y).steps;
  if (direction.z != 0)
    end = std::min(end, ((direction.z > 0 ? top_.z : bottom_.z) - from_m.z) / direction.z);
  if (!(end > 0) || !std::isfinite(end)) return 0;
  const auto outside_at = [&](double t) {
    return outside(from_m.x + t * direction.x, from_m.y + t * direction.y, from_m.z + t * direction.z);
  };
  const auto bracket = first_exit(outside_at, end);
  if (!bracket) return 0;
  return static_cast<float>(bracket->value_b <= 0 ? bracket->b : root(outside_at, *bracket));
}

}  // namespace espalier
