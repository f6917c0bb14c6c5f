// One trunk at the origin, or several spread by Poisson-disc sampling and leaning outwards.
#include <algorithm>
#include <cmath>

#include <espalier/weber_penn/trunks.h>

namespace espalier {

namespace {

constexpr float kLeanAtRimDeg = 2;  ///< [CH] says outwards only; by eye from its Figure 3.10

/// A uniform point of the unit disc.
Vec3 disc_point(RandomKey key, int attempt) {
  const float radius = std::sqrt(draw_unit(key, Draw::trunk_place, 2 * attempt));
  const float angle = radians(360 * draw_unit(key, Draw::trunk_place, 2 * attempt + 1));
  return {radius * std::cos(angle), radius * std::sin(angle), 0};
}

bool far_from_all(Vec3 place_m, const std::vector<GrowingStem>& stems, float distance_m) {
  return std::none_of(stems.begin(), stems.end(), [&](const GrowingStem& other) {
    return length(place_m - other.turtle.position_m) < distance_m;
  });
}

/// Dart throwing; where no dart fits any more, the distance asked for shrinks.
Vec3 free_place(RandomKey key, const std::vector<GrowingStem>& stems, float disc_radius_m, float distance_m) {
  constexpr int kDartsPerDistance = 60;
  for (int attempt = 0;; ++attempt) {
    const Vec3 place_m = disc_point(key, attempt) * disc_radius_m;
    if (far_from_all(place_m, stems, distance_m)) return place_m;
    if (attempt % kDartsPerDistance == kDartsPerDistance - 1) distance_m *= 0.8f;
  }
}

void lean_outwards(StemTurtle& turtle, float disc_radius_m) {
  const Vec3 outward = normalized(turtle.position_m, {1, 0, 0});
  turtle.right = cross(outward, turtle.forward);
  turtle.pitch_down(kLeanAtRimDeg * length(turtle.position_m) / disc_radius_m);
}

GrowingStem make_trunk(const WeberPennParameters& p, RandomKey key) {
  GrowingStem trunk;
  trunk.key = key;
  trunk.tree.scale_m = tree_scale_m(p, key);
  trunk.length_m = trunk_length_m(trunk, p);
  trunk.tree.base_length_m = trunk.length_m * p.base_size[0];
  trunk.turtle.roll_right(360 * draw_unit(key, Draw::trunk_roll));
  return trunk;
}

}  // namespace

float tree_scale_m(const WeberPennParameters& p, RandomKey trunk) {
  return std::max(0.f, p.g_scale + draw_signed(trunk, Draw::tree_scale) * p.g_scale_v);
}

float trunk_length_m(const GrowingStem& trunk, const WeberPennParameters& p) {
  return trunk.tree.scale_m * (p.length[0] + draw_signed(trunk.key, Draw::trunk_length) * p.length_v[0]);
}

void plant_trunks(const WeberPennParameters& p, RandomKey root, std::vector<GrowingStem>& stems) {
  const int count = std::max(1, static_cast<int>(p.branches[0]));
  const float trunk_radius_m = p.g_scale * p.ratio;
  const float disc_radius_m = 1.2f * std::sqrt(static_cast<float>(count) * trunk_radius_m / 2.5f);
  for (int index = 0; index < count; ++index) {
    GrowingStem trunk = make_trunk(p, child_key(root, index));
    if (count > 1) {
      trunk.turtle.position_m = free_place(trunk.key, stems, disc_radius_m, 2.5f * trunk_radius_m);
      lean_outwards(trunk.turtle, disc_radius_m);
    }
    stems.push_back(trunk);
  }
}

}  // namespace espalier
