// Trunks and periodically tapered stems are cut into about 100 pieces, so that flare and swelling show;
// the pieces lie exactly on the same curve.
#include <algorithm>
#include <cmath>

#include <espalier/weber_penn/scalar/stem_knots.h>

namespace espalier {

namespace {

constexpr int kFinePointsPerStem = 100;

int pieces_per_segment(const GrowingStem& stem, const WeberPennParameters& p) {
  if (stem.level > 0 && p.taper[level_index(stem.level)] <= 1) return 1;
  const int points = (kFinePointsPerStem + segment_count(stem, p) - 1) / segment_count(stem, p);
  return std::max(1, points - 1);
}

Vec3 derivative(const Segment& s, float t) {
  const float u = 1 - t;
  return ((s.handle_out_m - s.start_m) * (u * u) + (s.handle_in_m - s.handle_out_m) * (2 * u * t) +
          (s.end_m - s.handle_in_m) * (t * t)) *
         3;
}

void append_knot(Knots& knots, Vec3 point_m, Vec3 handle_m, float radius_m) {
  knots.point_m.push_back(point_m);
  knots.handle_in_m.push_back(point_m - handle_m);
  knots.handle_out_m.push_back(point_m + handle_m);
  knots.radius_m.push_back(radius_m);
}

}  // namespace

void append_knots(const GrowingStem& stem, const Segment& segment, const WeberPennParameters& p,
                  Knots& knots) {
  const int pieces = pieces_per_segment(stem, p);
  const auto radius_at = [&](float t) {
    return stem_radius_m(stem, segment.z_start + t * (segment.z_end - segment.z_start), p);
  };
  const auto handle_at = [&](float t) {
    return derivative(segment, t) * (1.f / (3 * static_cast<float>(pieces)));
  };
  const int parts = segment_count(stem, p) / segment_count(p, stem.level);
  const bool starts_stem = segment.z_start * static_cast<float>(segment_count(stem, p)) <
                           static_cast<float>(stem.first_segment * parts) + 0.5f;
  if (starts_stem)
    append_knot(knots, segment.start_m, handle_at(0), radius_at(0));
  else
    knots.handle_out_m.back() = segment.start_m + handle_at(0);
  for (int piece = 1; piece <= pieces; ++piece) {
    const float t = static_cast<float>(piece) / static_cast<float>(pieces);
    append_knot(knots, segment_point(segment, t), handle_at(t), radius_at(t));
  }
}

}  // namespace espalier
